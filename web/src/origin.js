// The card that tells where the selected part was written.

import { byId, h, show } from "./dom.js";
import { openLabel } from "./messages.js";

export class Origin {
  /** @param {object} told `onOpen({place, text})`, `onClose()` */
  constructor(told) {
    this.told = told;
    byId("origin-close").onclick = () => told.onClose();
  }

  /**
   * Show where a link, its joint and the body that was clicked come from.
   * @param {Robot} robot
   * @param {string|null} link
   * @param {object|null} shape the body, if one was clicked
   */
  set(robot, link, shape) {
    const known = robot?.linksKnown.get(link);
    show(byId("origin"), Boolean(known));
    if (!known) return;
    byId("origin-title").textContent = link;
    const joint = robot.jointAbove.get(link);
    const jointOrigin = joint && robot.jointsKnown.get(joint.name);
    const rows = [];
    const body = shape && known[shape.kind]?.[shape.index];
    if (body) rows.push(this.row(shape.kind, "", body, robot));
    rows.push(this.row("link", "", known, robot));
    if (jointOrigin) rows.push(this.row("joint", joint.name, jointOrigin, robot));
    byId("origin-rows").replaceChildren(...rows);
    const fits = fitsOf(robot, link, body && shape);
    byId("origin-fits").replaceChildren(...fits.map((text) => h("div", {}, text)));
    const calls = (body ?? known).calls;
    byId("origin-calls").replaceChildren(...calls.map((call) => this.call(call, robot)));
    show(byId("origin-calls"), calls.length > 0);
    byId("origin-facts").textContent = factsOf(robot, link);
    const first = body ?? known;
    byId("origin-open").onclick = () => this.open(first.place, robot);
    byId("origin-open").textContent = openLabel();
  }

  row(kind, name, origin, robot) {
    return h(
      "div.origin-row",
      { data: { kind } },
      h("span.kind", {}, kind),
      h("span.what", { title: name }, name),
      this.place(origin.place, robot),
    );
  }

  call({ kind, name, place }, robot) {
    return h(
      "div.call",
      {},
      h("span.in", {}, "in "),
      h("span.function", {}, name),
      h("span", {}, kind === "included" ? ", included at " : ", called at "),
      this.place(place, robot),
    );
  }

  place(number, robot) {
    const text = robot.description.places[number];
    return h(
      "button.place",
      { type: "button", title: `${text}: ${openLabel()}`, onclick: () => this.open(number, robot) },
      shortPlace(text),
    );
  }

  open(place, robot) {
    this.told.onOpen({ place, text: robot.description.places[place] });
  }
}

/** Return a place as `leg.yaml:12`: the column is for the editor. */
function shortPlace(text) {
  const [, file, line] = /^(.*):(\d+):\d+$/.exec(text) ?? [null, text, ""];
  return `${file.split(/[\\/]/).pop()}:${line}`;
}

/** Return how good shapes are that were worked out from meshes: of the body clicked, or of all. */
function fitsOf(robot, link, shape) {
  return (robot.description.fits ?? [])
    .filter((fit) => fit.link === link)
    .filter(
      ({ kind, index, count }) =>
        !shape || (kind === shape.kind && index <= shape.index && shape.index < index + count),
    )
    .map(({ asked, quality }) => `${asked}: ${quality}`);
}

function factsOf(robot, link) {
  const mass = robot.masses.get(link);
  const bodies = robot.shapes.filter((shape) => shape.link === link);
  const count = (kind) => bodies.filter((shape) => shape.kind === kind).length;
  const joint = robot.jointAbove.get(link);
  const facts = joint ? [joint.jointType] : [];
  if (Number.isFinite(mass)) facts.push(`${Number(mass.toPrecision(4))} kg`);
  for (const kind of ["visual", "collision"]) {
    if (count(kind)) facts.push(`${count(kind)} ${kind}${count(kind) > 1 ? "s" : ""}`);
  }
  return facts.join(" · ");
}
