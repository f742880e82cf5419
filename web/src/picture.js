// The button that saves a picture of the scene. In a frame, which may not save, the picture is shown too.

import { byId, show } from "./dom.js";
import { fileNameOf, pictureOf } from "./screenshot.js";

export class PictureCard {
  /** @param {object} told `stage`, `robot()`, `onSaved(text)` */
  constructor(told) {
    this.told = told;
    this.card = byId("picture-card");
    this.url = "";
    byId("picture").onclick = () => this.take();
    byId("picture-close").onclick = () => this.close();
  }

  /** Save the scene; what is only marked by the pointer is left out. */
  async take() {
    const robot = this.told.robot();
    if (!robot) return;
    const { hovered, selected } = robot.highlighted;
    robot.highlight("hovered", null);
    robot.highlight("selected", null);
    const style = getComputedStyle(document.documentElement);
    const probe = document.createElement("span");
    document.body.append(probe);
    const sky = ["--stage-top", "--stage-bottom"].map((name) => {
      probe.style.color = style.getPropertyValue(name);
      return getComputedStyle(probe).color;
    });
    probe.remove();
    const taken = pictureOf(this.told.stage, sky);
    robot.highlight("hovered", hovered);
    robot.highlight("selected", selected);
    this.told.stage.draw();
    try {
      this.save(await taken, fileNameOf(robot.name));
    } catch (error) {
      this.told.onSaved(`no picture: ${error.message}`);
    }
  }

  save(blob, name) {
    URL.revokeObjectURL(this.url);
    this.url = URL.createObjectURL(blob);
    const link = byId("picture-link");
    Object.assign(link, { href: this.url, download: name, textContent: name });
    link.click();
    const isFrame = window.parent !== window;
    if (isFrame) byId("picture-image").src = this.url;
    show(this.card, isFrame);
    if (!isFrame) this.told.onSaved(`saved ${name}`);
  }

  close() {
    show(this.card, false);
  }
}
