// The variables that a build does not take, by file: asked for when they are unfolded.

import { ask } from "./connection.js";
import { byId, h, show } from "./dom.js";
import { fileGroup } from "./variables.js";

export class Included {
  /** @param {object} told `variables`, `onOpen({place, version, text})` */
  constructor(told) {
    this.told = told;
    this.turn = 0;
    this.isOld = true;
    this.followers = [];
    this.openFiles = new Set();
    this.element = byId("included");
    this.element.ontoggle = () => this.refresh();
  }

  /** Take note that the robot was built again; `hasMore` is whether there can be such variables. */
  setBuild(hasMore) {
    show(this.element, hasMore);
    this.isOld = true;
    for (const follow of this.followers) follow();
    this.refresh();
  }

  async refresh() {
    if (!this.element.open || this.element.hidden || !this.isOld) return;
    this.isOld = false;
    const turn = ++this.turn;
    const answer = await ask("included", {});
    if (turn !== this.turn) return;
    this.followers = [];
    const groups = (answer.files ?? []).map(({ file, variables }) => {
      const group = fileGroup(file, variables.map((variable) => this.row(variable, answer.version)));
      group.open = this.openFiles.has(file);
      group.ontoggle = () => this.openFiles[group.open ? "add" : "delete"](file);
      return group;
    });
    const nothing = h("p.nothing", {}, answer.fault ?? "there are no others");
    byId("included-files").replaceChildren(...(groups.length ? groups : [nothing]));
  }

  row({ name, values, why, follows, place, text }, version) {
    const fields = follows && this.told.variables.fieldsOf(follows);
    if (fields) this.followers.push(fields.showValue);
    const shown = values.length > 1 ? `${values.length} values` : values[0];
    const title = fields ? `${why}; this is ${follows} of the main file` : why;
    return h(
      fields ? `div.variable-row.${this.told.variables.rows.get(follows).variable.kind}` : "div.fixed-row",
      { data: { included: name }, title },
      h("button.name", { type: "button", title: `${title}\n${text}`, onclick: () => this.told.onOpen({ place, version, text }) }, name),
      ...(fields
        ? fields.inputs
        : [h("output.fixed", { title: values.join("\n") }, shown), h("span.why", {}, why)]),
    );
  }
}
