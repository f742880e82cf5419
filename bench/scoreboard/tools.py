"""The tools: which versions, and how each is called, as its documentation recommends."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Route:
    """One conversion that a tool can do."""

    takes: str
    makes: str
    command: str
    """A line of a shell. {file} is the source beside which it runs, {base} its first link; for
    xacro {file} is the original, with {arguments} as name:=value, and {packages}."""
    result: str
    """The file that it writes, relative to where it runs; may have *."""


@dataclass(frozen=True)
class Tool:
    """A tool at one version."""

    name: str
    version: str
    url: str
    routes: tuple[Route, ...]
    packages: tuple[str, ...] = ()
    """What pip installs in the tool's own environment; none for the tool of this environment."""
    until: str = ""
    """The day of which its dependencies are, if it fails with newer ones; else the script's."""
    note: str = ""
    """What is said below the tables."""


def _python(code: str) -> str:
    return f'python -c "{code}"'


YAMARO = "yamaro {file} --repair-inertia --to"
OF_XACRO = "yamaro {file} {arguments} {packages} --meshes absolute --repair-inertia --to"
OUTPUTS = {"urdf": "out.urdf", "mjcf": "out.xml", "sdf": "out.sdf", "usd": "out.usda"}


def for_gazebo(takes: str, makes: str) -> str:
    """Return the option that writes what drives joints and sensors into a file for Gazebo."""
    return "--gazebo " if makes == "sdf" or (takes == "mjcf" and makes == "urdf") else ""


def _yamaro() -> tuple[Route, ...]:
    routes = [
        Route(takes, makes, f"{command} {makes} {for_gazebo(takes, makes)}-o {out}", out)
        for takes, command in (("urdf", YAMARO), ("mjcf", YAMARO), ("xacro", OF_XACRO))
        for makes, out in OUTPUTS.items()
        if takes != makes
    ]
    return tuple(routes)


def _cyberwave() -> tuple[Route, ...]:
    start = "from cyberwave_robot_format"
    parsers = {
        "urdf": f"{start}.urdf import URDFParser as P",
        "mjcf": f"{start}.mjcf import MJCFParser as P",
    }
    exporters = {
        "urdf": f"{start}.urdf import URDFExporter as E",
        "mjcf": f"{start}.mjcf import MJCFExporter as E",
        "usd": f"{start} import USDExporter as E",
    }
    return tuple(
        Route(
            takes,
            makes,
            _python(f"{one}; {two}; E().export(P().parse('{{file}}'), '{OUTPUTS[makes]}')"),
            OUTPUTS[makes],
        )
        for takes, one in parsers.items()
        for makes, two in exporters.items()
        if takes != makes
    )


TOOLS = (
    Tool("Yamaro", "", "", _yamaro(),
         note="`--repair-inertia`, as the message for an impossible inertia says."),
    Tool("MuJoCo", "4.0.0", "https://mujoco.readthedocs.io/en/stable/modeling.html#urdf-extensions",
         (Route("urdf", "mjcf", _python(
             "import mujoco; text = open('{file}').read().replace('</robot>', "
             "'<mujoco><compiler balanceinertia=\\'true\\' fusestatic=\\'false\\' "
             "strippath=\\'false\\'/></mujoco></robot>'); open('it.urdf', 'w').write(text); "
             "mujoco.mj_saveLastXML('out.xml', mujoco.MjModel.from_xml_path('it.urdf'))"),
             "out.xml"),),
         ("mujoco==4.0.0",),
         note="With `balanceinertia` and without `fusestatic`, which would merge links that joints "
              "fix. It fixes the first link in the world."),
    Tool("libsdformat", "12.3.0", "https://gazebosim.org/libs/sdformat/",
         (Route("urdf", "sdf", "ign sdf -p {file} > out.sdf", "out.sdf"),),
         note="`ign sdf -p` of Debian 12 (newer: `gz sdf -p`). It merges links that joints fix."),
    Tool("urdf-usd-converter", "0.3.4", "https://github.com/newton-physics/urdf-usd-converter",
         (Route("urdf", "usd", "urdf_usd_converter {file} out", "out/*.usda"),),
         ("urdf-usd-converter==0.3.4", "usd-exchange==3.0.1", "newton-usd-schemas==0.6.0",
          "numpy==2.4.6"),
         note="Keeps efforts as `urdf:limit:effort`, which no simulator reads: not counted."),
    Tool("mujoco-usd-converter", "0.8.0", "https://github.com/newton-physics/mujoco-usd-converter",
         (Route("mjcf", "usd", "mujoco_usd_converter {file} out", "out/*.usda"),),
         ("mujoco-usd-converter==0.8.0", "mujoco==3.16.0", "usd-exchange==3.0.1",
          "newton-usd-schemas==0.6.0", "numpy==2.4.6")),
    Tool("xacrodoc", "2.0.1", "https://github.com/adamheins/xacrodoc",
         (Route("xacro", "urdf", "xacrodoc {file} {paths} -o out.urdf {arguments}", "out.urdf"),
          Route("xacro", "mjcf", "xacrodoc {file} {paths} --mjcf --copy-assets-to own -o out.xml "
                "{arguments}", "out.xml")),
         ("xacrodoc[mujoco]==2.0.1", "mujoco==4.0.0"),
         note="Makes MJCF with MuJoCo's importer."),
    Tool("urdf2mjcf", "0.2.39", "https://github.com/kscalelabs/urdf2mjcf",
         (Route("urdf", "mjcf", "urdf2mjcf {file} --output out/out.xml --copy-meshes",
                "out/out.xml"),),
         ("urdf2mjcf==0.2.39", "mujoco==4.0.0", "trimesh==5.2.0", "numpy==2.4.6")),
    Tool("urdf-to-mjcf", "0.1.1", "https://github.com/discoverse-dev/urdf-to-mjcf",
         (Route("urdf", "mjcf", "urdf-to-mjcf {file} --output mjcf/out.xml", "mjcf/out.xml"),),
         ("urdf-to-mjcf==0.1.1", "mujoco==4.0.0", "trimesh==5.2.0", "numpy==2.4.6")),
    Tool("urdf-mujoco-converter", "0.1.0", "https://pypi.org/project/urdf-mujoco-converter/",
         (Route("urdf", "mjcf", "urdf-mujoco-converter {file} out --allow-convex-hull",
                "out/robot.xml"),),
         ("urdf-mujoco-converter==0.1.0", "mujoco==3.11.0", "trimesh==4.12.2", "numpy==2.4.6")),
    Tool("urdf2any", "0.3.0", "https://github.com/syundo0730/urdf2any",
         (Route("urdf", "mjcf", "urdf2any {file} -o out.xml", "out.xml"),
          Route("urdf", "usd", "urdf2any {file} -o out.usda", "out.usda")),
         ("urdf2any[mjcf-validate,skin]==0.3.0", "usd-core==26.11", "trimesh==5.2.0",
          "numpy==2.4.6")),
    Tool("truerig", "0.1.1", "https://github.com/Sputnikboi/truerig",
         (Route("urdf", "mjcf", "truerig convert {file} out.mjcf", "out.mjcf"),
          Route("urdf", "usd", "truerig convert {file} out.usda", "out.usda"),
          Route("mjcf", "urdf", "truerig convert {file} out.urdf", "out.urdf"),
          Route("mjcf", "usd", "truerig convert {file} out.usda", "out.usda")),
         ("truerig[usd]==0.1.1", "mujoco==4.0.0", "usd-core==26.11", "trimesh==5.2.0",
          "numpy==2.4.6"),
         note="Writes limits of MJCF to URDF without efforts and speeds, which urdfdom refuses."),
    Tool("scikit-robot", "0.4.7", "https://github.com/iory/scikit-robot",
         (Route("urdf", "mjcf", "convert-urdf-to-mjcf {file} -o out.xml", "out.xml"),
          Route("urdf", "usd", "convert-urdf-to-usd {file} -o out.usda", "out.usda")),
         ("scikit-robot==0.4.7", "usd-core==26.11", "pycollada", "numpy==2.4.6")),
    Tool("cyberwave-robot-format", "0.1.8", "https://pypi.org/project/cyberwave-robot-format/",
         _cyberwave(), ("cyberwave-robot-format[usd]==0.1.8", "usd-core==26.11", "numpy==2.4.6"),
         note="As truerig in URDF; keeps in USD what UsdPhysics cannot hold in attributes "
              "`cyberwave:…`: not counted."),
    Tool("mjcf-urdf-simple-converter", "0.7.3",
         "https://github.com/Yasu31/mjcf_urdf_simple_converter",
         (Route("mjcf", "urdf", _python(
             "from mjcf_urdf_simple_converter import convert; convert('{file}', 'out.urdf')"),
             "out.urdf"),),
         ("mjcf-urdf-simple-converter==0.7.3", "mujoco==4.0.0", "numpy==2.4.6"),
         note="Says that it keeps the kinematic structure only."),
    Tool("hurodes", "0.1.9", "https://github.com/ZyuonRobotics/humanoid-robot-description",
         tuple(Route(takes, makes,
                     "export HURODES_ASSETS_PATH=own; hurodes-parse {file} it "
                     f"--format-type {how} --base-link-name {{base}} && "
                     f"hurodes-generate it --format-type {makes} --not-view",
                     f"own/robots/it/{out}")
               for takes, how, makes, out in (
                   ("urdf", "urdf-mujoco", "mjcf", "exported/robot.xml"),
                   ("mjcf", "mjcf", "urdf", "exported/robot.urdf"))),
         ("hurodes[mesh]==0.1.9", "mujoco==3.4.0", "numpy==2.2.6"), "2025-12-31",
         note="Made for humanoids, and fails with MuJoCo and NumPy that are newer."),
)  # fmt: skip

NOT_TRIED = {
    "sdformat-mjcf 0.1.2": "needs Python bindings of libsdformat 13, which pip does not have",
    "rod 0.5.0": "needs a libsdformat newer than that of Debian 12",
    "NVIDIA's importers in Isaac Sim": "need Isaac Sim",
}
