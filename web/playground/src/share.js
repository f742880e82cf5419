// Files in the part of the address behind #, which the browser sends to nobody.

const MARK = "#robot=";

/** Return the part of an address that holds some files. */
export async function toHash(project) {
  const bytes = new TextEncoder().encode(JSON.stringify(project));
  return MARK + base64(await through(new CompressionStream("deflate-raw"), bytes));
}

/** Return the files that a part of an address holds, or null. */
export async function fromHash(hash) {
  if (!hash.startsWith(MARK)) return null;
  try {
    const bytes = Uint8Array.from(
      atob(hash.slice(MARK.length).replaceAll("-", "+").replaceAll("_", "/")),
      (letter) => letter.charCodeAt(0),
    );
    const text = await through(new DecompressionStream("deflate-raw"), bytes);
    const { files, main } = JSON.parse(new TextDecoder().decode(text));
    const isProject = typeof files === "object" && typeof files[main] === "string";
    return isProject && Object.values(files).every((one) => typeof one === "string") ? { files, main } : null;
  } catch {
    return null;
  }
}

async function through(stream, bytes) {
  const passed = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(passed).arrayBuffer());
}

function base64(bytes) {
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}
