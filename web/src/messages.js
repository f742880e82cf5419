// Errors over the robot, warnings below the tree: as the terminal shows them, in colours.

import { byId, h, show } from "./dom.js";

/** Return a rendered diagnostic as an element. */
export function diagnosticText(text, severity) {
  const lines = text.split("\n").map((line, index) => {
    let kind = "plain";
    if (index === 0) kind = `head ${severity}`;
    else if (/^\s*-->/.test(line)) kind = "at";
    else if (/^\s*\d* \|\s+\^+$/.test(line)) kind = `mark ${severity}`;
    else if (/^\s*=/.test(line)) kind = "remark";
    return h("span", { className: kind, textContent: `${line}\n` });
  });
  return h("pre.diagnostic", {}, ...lines);
}

/** The card over the robot that tells why the file cannot be built. */
export class Fault {
  /** @param {object} told `onOpen({place, isFault})` */
  constructor(told) {
    this.told = told;
    this.card = byId("fault");
    byId("fault-fold").onclick = () => this.card.classList.toggle("folded");
  }

  /** Show what is wrong, or nothing. */
  set(fault, hasRobot) {
    show(this.card, Boolean(fault));
    document.body.classList.toggle("has-fault", Boolean(fault));
    if (!fault) {
      this.card.classList.remove("folded");
      return;
    }
    const count = fault.diagnostics.length;
    byId("fault-title").textContent = count > 1 ? `${count} errors` : "Error";
    byId("fault-note").textContent = hasRobot ? "this is the robot as it was before" : "";
    const parts = fault.diagnostics.map((one) =>
      h("div.entry", {}, diagnosticText(one.text, one.severity), this.opener(one, fault.places)),
    );
    if (fault.fault) parts.unshift(h("pre.diagnostic", {}, fault.fault));
    byId("fault-text").replaceChildren(...parts);
  }

  opener({ place }, places) {
    return h(
      "button.open",
      { type: "button", onclick: () => this.told.onOpen({ place, text: places[place], isFault: true }) },
      openLabel(),
    );
  }
}

/** The list of warnings. */
export class Warnings {
  /** @param {object} told `onSelect({link, joint})`, `onOpen({place})` */
  constructor(told) {
    this.told = told;
    this.ofMeshes = [];
  }

  /** Show the warnings of a robot. */
  set(diagnostics, places) {
    this.diagnostics = diagnostics;
    this.places = places;
    this.ofMeshes = [];
    this.render();
  }

  /** Add that a mesh is there and cannot be shown. */
  addMeshFault(mesh, reason) {
    const message = `the mesh '${mesh}' cannot be shown: ${reason}`;
    if (this.ofMeshes.some((one) => one.message === message)) return;
    this.ofMeshes.push({ code: "mesh", severity: "warning", message, text: message });
    this.render();
  }

  render() {
    const all = [...this.diagnostics, ...this.ofMeshes];
    byId("warning-count").textContent = String(all.length);
    show(byId("warnings-pane"), all.length > 0);
    document.body.classList.toggle("has-warnings", all.length > 0);
    byId("warnings").replaceChildren(...all.map((one) => this.entry(one)));
  }

  entry(one) {
    const text = h("div.more", { hidden: true }, diagnosticText(one.text, one.severity));
    if (one.place !== undefined) {
      const place = { place: one.place, text: this.places[one.place] };
      text.append(
        h("button.open", { type: "button", onclick: () => this.told.onOpen(place) }, openLabel()),
      );
    }
    return h(
      "div.warning",
      { data: { code: one.code } },
      h(
        "button.title",
        {
          type: "button",
          onclick: () => {
            show(text, text.hidden);
            if (one.link || one.joint) this.told.onSelect(one);
          },
        },
        h("span.sign", {}, "▲"),
        h("span", {}, one.message),
      ),
      text,
    );
  }
}

/** What the buttons say that lead to a place: that depends on whether there is an editor. */
export const openLabel = () => (document.body.dataset.editor ? `Open in ${document.body.dataset.editor}` : "Copy place");
