// The kinematic tree: a row for each link, with the joint that holds it.

import { byId, h, show } from "./dom.js";
import { childOf } from "./urdf.js";

const JOINT_SIGNS = new Map([
  ["revolute", "↻"],
  ["continuous", "⟳"],
  ["prismatic", "↕"],
  ["planar", "▱"],
  ["floating", "✦"],
  ["fixed", "·"],
]);
const FEW = 9; // rows that need no search

export class Tree {
  /** @param {object} told `onSelect(link)`, `onHover(link)` */
  constructor(told) {
    this.told = told;
    this.rows = new Map();
    this.folded = new Set();
    this.search = byId("tree-search");
    this.search.oninput = () => this.filter();
  }

  /** Show a robot's tree. */
  setRobot(robot) {
    const list = byId("tree");
    const below = new Map();
    for (const joint of robot.joints.values()) {
      const parent = childOf(joint.urdfNode, "parent").getAttribute("link");
      if (!below.has(parent)) below.set(parent, []);
      below.get(parent).push(joint);
    }
    this.rows.clear();
    const rows = [];
    const pending = robot.roots.map((link) => ({ link, joint: null, depth: 0 })).reverse();
    while (pending.length) {
      const step = pending.pop();
      const joints = below.get(step.link) ?? [];
      rows.push(this.row({ ...step, isLeaf: !joints.length }));
      for (const joint of [...joints].reverse()) {
        const link = childOf(joint.urdfNode, "child").getAttribute("link");
        pending.push({ link, joint, depth: step.depth + 1, parent: step.link });
      }
    }
    list.replaceChildren(...rows);
    byId("tree-count").textContent = String(rows.length);
    show(this.search, rows.length > FEW);
    this.filter();
  }

  row({ link, joint, depth, isLeaf, parent }) {
    const fold = h("button.fold", {
      type: "button",
      textContent: "▾",
      title: "Fold",
      tabIndex: -1,
      onclick: (event) => {
        event.stopPropagation();
        this.toggle(link);
      },
    });
    fold.hidden = isLeaf;
    const sign = joint ? JOINT_SIGNS.get(joint.jointType) ?? "?" : "◆";
    const row = h(
      "div.row",
      {
        tabIndex: -1, // one row at a time can be tabbed to: see `letFocus`
        role: "treeitem",
        data: { link, joint: joint?.name ?? "" },
        title: joint ? `${link}, ${joint.jointType} ${joint.name}` : link,
        onclick: () => this.told.onSelect(link),
        onkeydown: (event) => this.onKey(event, link),
        onfocus: () => this.letFocus(link),
        onmouseenter: () => this.told.onHover(link),
        onmouseleave: () => this.told.onHover(null),
      },
      h("span.sign", { textContent: sign, title: joint ? joint.jointType : "root" }),
      h("span.link", { textContent: link }),
      joint && h("span.joint", { textContent: joint.name, title: `${joint.jointType} joint` }),
      fold,
    );
    row.style.setProperty("--depth", depth);
    this.rows.set(link, { row, fold, parent, text: `${link} ${joint?.name ?? ""}`.toLowerCase() });
    return row;
  }

  /** Let Tab come to a row, and leave the tree from there. */
  letFocus(link) {
    for (const [name, { row }] of this.rows) row.tabIndex = name === link ? 0 : -1;
  }

  onKey(event, link) {
    const seen = [...this.rows.values()].map(({ row }) => row).filter((row) => !row.hidden);
    const place = seen.indexOf(this.rows.get(link).row);
    const places = { ArrowDown: place + 1, ArrowUp: place - 1, Home: 0, End: seen.length - 1 };
    if (event.key === "Enter") this.told.onSelect(link);
    else if (event.key === "ArrowLeft" && !this.folded.has(link)) this.toggle(link);
    else if (event.key === "ArrowRight" && this.folded.has(link)) this.toggle(link);
    else if (event.key in places) {
      event.preventDefault();
      seen[places[event.key]]?.focus();
    }
  }

  toggle(link) {
    if (!this.folded.delete(link)) this.folded.add(link);
    this.filter();
  }

  /** Show the rows that are not folded away, or those that have the searched text in them. */
  filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const { row, fold, parent, text } of this.rows.values()) {
      const above = this.rows.get(parent);
      const isFolded = above && (above.row.dataset.isFolded || this.folded.has(parent));
      if (isFolded) row.dataset.isFolded = "yes";
      else delete row.dataset.isFolded;
      row.hidden = wanted ? !text.includes(wanted) : Boolean(isFolded);
      fold.textContent = this.folded.has(row.dataset.link) ? "▸" : "▾";
    }
    const seen = [...this.rows.values()].filter(({ row }) => !row.hidden);
    if (seen.length && !seen.some(({ row }) => row.tabIndex === 0)) seen[0].row.tabIndex = 0;
  }

  /** Mark a link as "hovered" or "selected"; null marks none. */
  mark(how, link) {
    for (const { row } of this.rows.values()) row.classList.remove(how);
    const found = this.rows.get(link)?.row;
    if (!found) return;
    found.classList.add(how);
    if (how === "selected") found.scrollIntoView({ block: "nearest" });
  }
}
