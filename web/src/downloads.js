// The menu that offers the robot as a file: what a format cannot hold is shown beside the file.

import { ask } from "./connection.js";
import { byId, h, show } from "./dom.js";
import { diagnosticText } from "./messages.js";

const KILO = 1000;

export class Downloads {
  constructor() {
    this.button = byId("download");
    this.card = byId("downloads");
    this.result = byId("download-result");
    this.turn = 0;
    this.button.onclick = () => this.toggle(this.card.hidden);
    for (const format of this.formats()) format.onclick = () => this.write(format.dataset.format);
    document.addEventListener("pointerdown", ({ target }) => {
      if (!this.card.contains(target) && !this.button.contains(target)) this.toggle(false);
    });
  }

  formats() {
    return this.card.querySelectorAll("[data-format]");
  }

  toggle(isOpen) {
    show(this.card, isOpen);
    this.button.setAttribute("aria-expanded", String(isOpen));
  }

  /** Have a format written, save its file, and show what it could not hold. */
  async write(format) {
    const turn = ++this.turn;
    for (const each of this.formats()) {
      each.setAttribute("aria-pressed", String(each.dataset.format === format));
    }
    this.show("busy", h("p", {}, `writing ${format.toUpperCase()} …`));
    const answer = await ask("download", { format });
    if (turn !== this.turn) return; // another format was asked for meanwhile
    const texts = (answer.diagnostics ?? []).map((one) => diagnosticText(one.text, one.severity));
    if (answer.key === undefined) {
      if (answer.fault) texts.unshift(h("pre.diagnostic", {}, answer.fault));
      this.show("failed", h("p", {}, `${format.toUpperCase()} cannot be written`), ...texts);
      return;
    }
    const link = h("a.file-link", { href: answer.href ?? `download/${answer.key}`, download: answer.name }, answer.name);
    const lost = texts.length ? [h("p.lost-note", {}, `What ${format.toUpperCase()} cannot hold:`)] : [];
    this.show("done", h("p", {}, link, ` ${sizeText(answer.bytes)}`), ...lost, ...texts);
    link.click();
  }

  show(kind, ...content) {
    this.result.className = `result ${kind}`;
    this.result.replaceChildren(...content);
    show(this.result, true);
  }
}

function sizeText(bytes) {
  if (bytes < KILO) return `${bytes} bytes`;
  const isSmall = bytes < KILO ** 2;
  return `${Number((bytes / (isSmall ? KILO : KILO ** 2)).toPrecision(2))} ${isSmall ? "kB" : "MB"}`;
}
