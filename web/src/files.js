// Where the files of a robot come from: the server, or the page itself.

let held = null; // key → {bytes, address} if the page has them

/** Take files from the page: bytes and an address for each key, and no others from anywhere. */
export function holdFiles(files) {
  held = files;
}

/** Return the address of a file. */
export const addressOf = (key) => (held ? (held.get(key)?.address ?? "data:,") : `file/${key}`);

/** Return the bytes of a file. */
export async function bytesOf(key) {
  if (held) {
    if (!held.has(key)) throw new Error("it is not in this page");
    return held.get(key).bytes;
  }
  const response = await fetch(addressOf(key));
  if (!response.ok) throw new Error("it cannot be fetched");
  return response.arrayBuffer();
}
