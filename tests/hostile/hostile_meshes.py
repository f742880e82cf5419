"""Meshes that nobody should write: bombs, circles, lies about sizes, names of others' files.

HOSTILE holds those that have to be refused, with a piece of the reason; HARMLESS those that are
read, or refused for what is missing, without touching the files that they name.
"""

from __future__ import annotations

import base64
import json
import struct
import zlib
from typing import Any

HOSTILE: dict[str, tuple[bytes, str]] = {}
HARMLESS: dict[str, bytes] = {}
TEXTURES: dict[str, bytes] = {}

# --- COLLADA ------------------------------------------------------------------------------------

GEOMETRY = (
    '<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">'
    '0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa" count="3" stride="3">'
    '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>'
    '</accessor></technique_common></source><vertices id="v"><input semantic="POSITION"'
    ' source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v"'
    ' offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>'
)
PLACED = '<instance_geometry url="#g"/>'


def dae(content: str = PLACED, *, nodes: str = "", head: str = "", more: str = "") -> str:
    scene = f'<visual_scene id="s"><node id="q">{content}</node></visual_scene>'
    return (
        f'<?xml version="1.0"?>{head}<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"'
        f' version="1.4.1"><asset><unit meter="1"/></asset>{more}{GEOMETRY}<library_nodes>{nodes}'
        f"</library_nodes><library_visual_scenes>{scene}</library_visual_scenes>"
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )


def node(name: str, *places: str) -> str:
    inside = "".join(f'<instance_node url="#{place}"/>' for place in places)
    return f'<node id="{name}">{inside}</node>'


def refuse(name: str, content: str | bytes, reason: str) -> None:
    HOSTILE[name] = (content.encode() if isinstance(content, str) else content, reason)


TOWER = f'<node id="n0">{PLACED}</node>' + "".join(
    node(f"n{i}", *[f"n{i - 1}"] * 10) for i in range(1, 9)
)
DOCTYPE = "it has a document type"
ENTITIES = "".join(
    f'<!ENTITY a{i} "{f"&a{i - 1};" * 10 if i else "ha"}">' for i in range(10)
)  # fmt: skip
EXTERNAL = '<!DOCTYPE x [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
OK_DAE = dae()
refuse("a tower of nodes.dae", dae('<instance_node url="#n8"/>', nodes=TOWER), "10,000 bodies")
refuse("a body placed often.dae", dae(PLACED * 20_000), "10,000 bodies")
refuse("nodes in a circle.dae", dae(nodes=node("a", "b") + node("b", "a"),
       content='<instance_node url="#a"/>'), "in a circle")  # fmt: skip
refuse("a node in itself.dae", dae('<instance_node url="#a"/>', nodes=node("a", "a")), "a circle")
refuse("deep nodes.dae", dae("<node>" * 9_000 + PLACED + "</node>" * 9_000), "in one another")
refuse("entities that grow.dae", dae(f"&a9;{PLACED}", head=f"<!DOCTYPE x [{ENTITIES}]>"), DOCTYPE)
refuse("an entity of another file.dae", dae(f"&x;{PLACED}", head=EXTERNAL), DOCTYPE)
refuse("a document type elsewhere.dae",
       dae(head='<!DOCTYPE x SYSTEM "http://127.0.0.1:9/x.dtd">'), DOCTYPE)  # fmt: skip
WIDE = dae(f"&x;{PLACED}", head=EXTERNAL).replace('<?xml version="1.0"?>', "")
refuse("a document type in UTF-16.dae", WIDE.encode("utf-16"), DOCTYPE)
for encoding in ("utf-7", "cp037", "shift_jis", "x-none"):
    text = OK_DAE.replace('version="1.0"?', f'version="1.0" encoding="{encoding}"?')
    refuse(f"the encoding {encoding}.dae", text, "encoding")
refuse("another root.dae", "<html/>", "its root is not <COLLADA>")
refuse("an index below 0.dae", OK_DAE.replace("<p>0 1 2", "<p>0 1 -5"), "trimesh cannot read it")
refuse("a unit beyond all numbers.dae", OK_DAE.replace('meter="1"', 'meter="1e308"'), "coordinate")
refuse("a unit that is none.dae", OK_DAE.replace('meter="1"', 'meter="nan"'), "coordinate")
PASSWD = (
    '<library_images><image id="i"><init_from>/etc/passwd</init_from></image><image id="j">'
    "<init_from>file:///dev/zero</init_from></image></library_images>"
)
HARMLESS["images that are no images.dae"] = dae(more=PASSWD).encode()
HARMLESS["counts that lie.dae"] = OK_DAE.replace('count="', 'count="99999').encode()

# --- glTF -----------------------------------------------------------------------------------------

TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def data_uri(data: bytes) -> str:
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


def gltf(**others: Any) -> bytes:
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 4}]}],
        "buffers": [{"byteLength": 36, "uri": data_uri(TRIANGLE)}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [accessor()],
    }
    return json.dumps({**document, **others}).encode()


def accessor(**others: Any) -> dict[str, Any]:
    return {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", **others}


TREE = "its nodes are not a tree"
ODD = "its parts are not as glTF has them"
DOUBLING = [*({"children": [i + 1, i + 1]} for i in range(40)), {"mesh": 0}]
refuse("nodes that double.gltf", gltf(nodes=DOUBLING), TREE)
refuse(
    "nodes in a circle.gltf", gltf(nodes=[{"children": [1]}, {"children": [0], "mesh": 0}]), TREE
)
refuse("a node in itself.gltf", gltf(nodes=[{"children": [0], "mesh": 0}]), TREE)
refuse("a node with two above.gltf",
       gltf(nodes=[{"children": [2]}, {"children": [2]}, {"mesh": 0}]), TREE)  # fmt: skip
refuse("a child that is not there.gltf", gltf(nodes=[{"children": [7], "mesh": 0}]), ODD)
refuse("a mesh placed often.gltf", gltf(nodes=[{"mesh": 0}] * 20_000), "10,000 bodies")
OFTEN = [{"primitives": [{"attributes": {"POSITION": 0}}] * 20_000}]
refuse("one accessor used often.gltf", gltf(meshes=OFTEN), "10,000 bodies")
refuse("a count of a trillion.gltf", gltf(accessors=[accessor(count=1 << 40)]), "too many items")
ZEROS = {"componentType": 5126, "count": 1 << 34, "type": "VEC3"}
refuse("a count without a buffer.gltf", gltf(accessors=[ZEROS]), "too many items")
for wrong in (-1, 3.5, "3", None, True):
    refuse(f"the count {wrong}.gltf", gltf(accessors=[accessor(count=wrong)]), ODD)
refuse("a place beyond the buffer.gltf", gltf(accessors=[accessor(byteOffset=10**12)]), "trimesh")
refuse("lists in lists.gltf", b'{"asset":' + b"[" * 10**6, "its JSON is broken")
refuse("JSON of another kind.gltf", b'{"a": 1}', "it is not glTF")
refuse("a chunk of another kind.glb", b"glTF" + bytes(16), "its first chunk is not JSON")
for uri in (
    "file:///etc/passwd",
    "/etc/passwd",
    "../../../../../../etc/passwd",
    "%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd",
    "..\\..\\..\\..\\..\\..\\etc\\passwd",
    "http://127.0.0.1:9/x.bin",
    "/dev/zero",
    "fifo",
    ".",
    "a\0b",
    "link",
    "a" * 10_000,
):
    shown = uri[:40].replace("/", "|").replace("\0", "0")
    refuse(f"a buffer at {shown}.gltf", gltf(buffers=[{"byteLength": 36, "uri": uri}]), "it names")

# --- PLY, OFF, STL, OBJ ---------------------------------------------------------------------------

PLY = (
    "ply\nformat {} 1.0\ncomment TextureFile ../../../etc/passwd\nelement vertex {}\n"
    "property float x\nproperty float y\nproperty float z\nelement face {}\n"
    "property list {} int vertex_indices\nend_header\n"
)
BINARY = "binary_little_endian"
MORE = "more than it can"
CORNERS = "0 0 0\n1 0 0\n0 1 0\n"
refuse("billions of corners.ply", PLY.format("ascii", 4 * 10**9, 1, "uchar") + CORNERS, MORE)
refuse("fewer than no corners.ply", PLY.format("ascii", -3, 1, "uchar") + CORNERS, MORE)
refuse("a list of billions.ply", PLY.format(BINARY, 3, 1, "uint").encode() + TRIANGLE
       + struct.pack("<I3i", 1 << 31, 0, 1, 2), "trimesh cannot read it")  # fmt: skip
refuse("a list of fewer than none.ply", PLY.format(BINARY, 3, 1, "int").encode() + TRIANGLE
       + struct.pack("<i3i", -3, 0, 1, 2), "trimesh cannot read it")  # fmt: skip
refuse("a corner that is not there.ply",
       PLY.format("ascii", 3, 1, "uchar") + CORNERS + "3 0 1 77777\n", "")  # fmt: skip
refuse("a header without an end.ply", "ply\n" + "comment x\n" * 20_000, "its header has no end")
HARMLESS["a texture elsewhere.ply"] = (
    PLY.format("ascii", 3, 1, "uchar") + CORNERS + "3 0 1 2\n"
).encode()
refuse(
    "a header that lies.stl", bytes(80) + b"\xff\xff\xff\xff" + bytes(50), "not a valid STL file"
)
refuse(
    "no numbers.stl", bytes(80) + struct.pack("<I12fH", 1, *[float("nan")] * 12, 0), "coordinate"
)
refuse("corners without numbers.stl", "solid " + "vertex " * 100_000, "not three numbers")
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
refuse("a corner that is not there.obj", OBJ + "f 1 2 999999999\n", "")
HARMLESS["names of other files.obj"] = (
    "mtllib ../../../etc/passwd\nmtllib /dev/zero\nmtllib fifo\nmtllib .\n" + OBJ + "f 1 2 3\n"
).encode()
HARMLESS["a line of spaces.obj"] = (OBJ + "f 1 2 3\nmtllib" + " " * 200_000).encode()
HARMLESS["a word again and again.obj"] = (OBJ + "f 1 2 3\n" + " mtllib" * 200_000).encode()

# --- textures -------------------------------------------------------------------------------------


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width: int, height: int, more: bytes = b"") -> bytes:
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    return (
        b"\x89PNG\r\n\x1a\n"
        + head
        + more
        + chunk(b"IDAT", zlib.compress(b""))
        + chunk(b"IEND", b"")
    )


TEXTURES["100,000 by 100,000"] = png(100_000, 100_000)
TEXTURES["a row of a billion"] = png(1 << 30, 1)
TEXTURES["no pixels"] = png(0, 0)
TEXTURES["text that grows"] = png(4, 4, chunk(b"zTXt", b"k\0\0" + zlib.compress(bytes(64 << 20))))
TEXTURES["EPS"] = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 16 16\nshowpage\n%%EOF\n"
TEXTURES["EPS with a preview"] = b"\xc5\xd0\xd3\xc6" + bytes(26) + TEXTURES["EPS"]
TEXTURES["an icon"] = b"\0\0\1\0\1\0\x10\x10\0\0\1\0\x20\0\x68\4\0\0\x16\0\0\0" + bytes(1128)
TEXTURES["a JPEG of 65,500 by 65,500"] = (
    b"\xff\xd8\xff\xe0\0\x10JFIF\0\1\1\0\0\1\0\1\0\0\xff\xc0\0\x11\x08\xff\xdc\xff\xdc\3\1\x22\0"
    b"\2\x11\1\3\x11\1\xff\xd9"
)
TEXTURES["a GIF of 65,535 by 65,535"] = (
    b"GIF89a\xff\xff\xff\xff\x80\0\0\0\0\0\xff\xff\xff,\0\0\0\0\1\0\1\0\0\2\2D\1\0;"
)
TEXTURES["nothing"] = b""


def textured_gltf(image: bytes) -> bytes:
    """Return a triangle with an image on it, in the file itself."""
    corners = TRIANGLE + struct.pack("<6f", 0, 0, 1, 0, 0, 1)
    views = [(0, 36), (36, 24), (60, len(image))]
    return gltf(
        buffers=[{"byteLength": 60 + len(image), "uri": data_uri(corners + image)}],
        bufferViews=[{"buffer": 0, "byteOffset": s, "byteLength": n} for s, n in views],
        accessors=[accessor(), accessor(bufferView=1, type="VEC2")],
        images=[{"bufferView": 2, "mimeType": "image/png"}],
        textures=[{"source": 0}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
    )


TEXTURED_OBJ = (
    "mtllib m.mtl\nusemtl m\n" + OBJ + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
).encode()
TEXTURED_MTL = b"newmtl m\nmap_Kd wood.png\n"
