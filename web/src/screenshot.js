// A PNG of the scene, without what lies over it.

const LEAST_SIDE = 1600; // pixels of the longer side
const MOST_SCALE = 4;

/**
 * Return a picture of the stage in the colours of the page.
 * @param {Stage} stage
 * @param {string[]} sky the colours at the top and at the bottom
 * @returns {Promise<Blob>}
 */
export function pictureOf(stage, sky) {
  const { clientWidth: width, clientHeight: height } = stage.canvas;
  const scale = Math.min(Math.max(LEAST_SIDE / Math.max(width, height), window.devicePixelRatio), MOST_SCALE);
  const before = stage.renderer.getPixelRatio();
  const canvas = document.createElement("canvas");
  canvas.width = Math.floor(width * scale);
  canvas.height = Math.floor(height * scale);
  const paper = canvas.getContext("2d");
  const gradient = paper.createLinearGradient(0, 0, 0, canvas.height);
  sky.forEach((color, index) => gradient.addColorStop(index, color));
  paper.fillStyle = gradient;
  paper.fillRect(0, 0, canvas.width, canvas.height);
  try {
    stage.renderer.setPixelRatio(scale);
    stage.drawNow();
    paper.drawImage(stage.canvas, 0, 0, canvas.width, canvas.height);
  } finally {
    stage.renderer.setPixelRatio(before);
    stage.drawNow();
  }
  return new Promise((settle, refuse) =>
    canvas.toBlob((blob) => (blob ? settle(blob) : refuse(new Error("the browser gives no picture"))), "image/png"),
  );
}

/** Return the name of a robot as that of a file. */
export const fileNameOf = (name) => `${name.replaceAll(/[^\p{L}\p{N}._-]+/gu, "_").replace(/^[._]+/, "") || "robot"}.png`;
