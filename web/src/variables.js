// The arguments or variables of the main file as fields. Changing one has the robot built with it; the
// file stays as it is.

import { copy } from "./copying.js";
import { byId, h, show } from "./dom.js";

const STEPS = 200;
const SCRUB_PIXELS = 3; // of the pointer's way for each step

export class Variables {
  /** @param {object} told `onChange({name: value})`, `onOpen(name)`, `onCopied()` */
  constructor(told) {
    this.told = told;
    this.rows = new Map();
    this.shape = "";
    byId("variable-reset").onclick = () => this.reset();
    byId("assignments").onclick = () => this.copyAssignments();
  }

  /** Show the variables; a field that is being edited is left alone. */
  set(variables, file, hasMore) {
    this.file = file;
    const shape = JSON.stringify(variables.map(({ value, line, ...rest }) => rest));
    if (shape !== this.shape) {
      this.shape = shape;
      this.rows.clear();
      for (const variable of variables) this.rows.set(variable.name, this.rowOf(variable));
      byId("variables").replaceChildren(...this.groups(variables));
    }
    for (const variable of variables) {
      const row = this.rows.get(variable.name);
      row.variable = variable;
      row.showValue(variable.value);
      row.element.classList.toggle("changed", variable.value !== variable.default);
      const place = `${variable.file ? nameOf(variable.file) : this.file}:${variable.line}`;
      row.element.querySelector(".name").title = variable.help ? `${variable.help}\n${place}` : place;
    }
    byId("variable-count").textContent = String(variables.length);
    const isShown = variables.length > 0 || Boolean(hasMore);
    show(byId("variables-pane"), isShown);
    document.body.classList.toggle("has-variables", isShown);
    this.showAssignments();
  }

  /** Return the rows: first those of the main file, then the files that it includes, folded. */
  groups(variables) {
    const files = new Map();
    for (const { name, file } of variables) {
      if (!files.has(file)) files.set(file, []);
      files.get(file).push(this.rows.get(name).element);
    }
    const own = files.get(undefined) ?? [];
    files.delete(undefined);
    return [...own, ...[...files].map(([file, rows]) => fileGroup(file, rows))];
  }

  /**
   * Return fields for a variable that are not among the others: they follow it, and set it.
   * @returns {object|null} `inputs`, and `showValue`
   */
  fieldsOf(name) {
    const main = this.rows.get(name);
    if (!main) return null;
    const row = { variable: main.variable };
    const { inputs, showValue } = MAKERS[main.variable.kind](row, (value) => {
      main.showValue(value);
      main.send(value);
    });
    showValue(main.variable.value);
    return { inputs, showValue: () => showValue((row.variable = main.variable).value) };
  }

  rowOf(variable) {
    const { name, kind, unit } = variable;
    const row = { variable };
    const send = (value) => {
      row.variable = { ...row.variable, value };
      row.element.classList.toggle("changed", value !== row.variable.default);
      this.showAssignments();
      this.told.onChange({ [name]: value });
    };
    row.send = send;
    const { inputs, showValue, scrub } = MAKERS[kind](row, send);
    row.showValue = showValue;
    const label = h(
      "button.name",
      { type: "button", ondblclick: () => this.told.onOpen(name) },
      name,
      ...(unit ? [h("span.unit", {}, ` ${unit}`)] : []),
    );
    if (scrub) followScrub(label, scrub);
    const undo = h(
      "button.undo",
      {
        type: "button",
        title: `back to ${variable.default}`,
        ariaLabel: `${name}: back to ${variable.default}`,
        onclick: () => {
          showValue(variable.default);
          row.variable = { ...row.variable, value: row.variable.default };
          row.element.classList.remove("changed");
          this.showAssignments();
          this.told.onChange({ [name]: null });
        },
      },
      "↺",
    );
    row.element = h(`div.variable-row.${kind}`, { data: { variable: name } }, label, ...inputs, undo);
    return row;
  }

  reset() {
    const changed = [...this.rows].filter(([, row]) => row.variable.value !== row.variable.default);
    if (changed.length) this.told.onChange(Object.fromEntries(changed.map(([name]) => [name, null])));
  }

  /** Return what to write on the command line for the same robot. */
  assignments() {
    return [...this.rows.values()]
      .map(({ variable }) => variable)
      .filter(({ value, default: own }) => value !== own)
      .map(({ name, value }) => shellWord(name, typeof value === "string" ? quoted(value) : value))
      .join(" ");
  }

  showAssignments() {
    const text = this.assignments();
    byId("assignments").textContent = text;
    show(byId("assignments"), text !== "");
    show(byId("variable-reset"), text !== "");
  }

  async copyAssignments() {
    if (await copy(this.assignments())) this.told.onCopied();
  }
}

const MAKERS = { number: numberInputs, boolean: switchInput, text: textInput, choice: choiceInput };

export const nameOf = (path) => path.split(/[\\/]/).pop();

/** Return the variables of a file, folded. */
export function fileGroup(file, rows) {
  return h("details.file-group", {}, h("summary", { title: file }, `${nameOf(file)} `, h("span.count", {}, String(rows.length))), ...rows);
}

function numberInputs(row, send) {
  const { name, default: own, isWhole, isLog } = row.variable;
  const step = row.variable.step ?? stepOf(own, isWhole);
  const [least, most] = rangeOf(row.variable);
  // A logarithmic slider has the number's logarithm as its position.
  const toSlider = isLog ? Math.log : (value) => value;
  const fromSlider = isLog ? Math.exp : (position) => position;
  const finest = isWhole && (own !== 0 || row.variable.least !== undefined) ? 1 : (most - least) / STEPS;
  const slider = h("input", {
    type: "range",
    min: String(toSlider(least)),
    max: String(toSlider(most)),
    step: isLog ? "any" : String(row.variable.step ?? finest),
    oninput: () => change(fromSlider(Number(slider.value))),
  });
  slider.setAttribute("aria-label", name);
  const field = h("input.number", {
    type: "number",
    step: "any",
    oninput: () => field.value !== "" && Number.isFinite(field.valueAsNumber) && change(field.valueAsNumber),
    onkeydown: (event) => {
      const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!direction) return;
      event.preventDefault();
      change(tidy(field.valueAsNumber + direction * step * (event.shiftKey ? 10 : 1)));
      field.value = String(row.variable.value);
    },
  });
  field.setAttribute("aria-label", `${name}, value`);

  function showValue(value) {
    const position = toSlider(value);
    slider.min = String(Math.min(toSlider(least), position));
    slider.max = String(Math.max(toSlider(most), position));
    slider.value = String(position);
    const share = (position - Number(slider.min)) / (Number(slider.max) - Number(slider.min));
    slider.style.setProperty("--share", `${100 * (share || 0)}%`);
    if (document.activeElement !== field) field.value = String(value);
  }
  function change(value) {
    const tidied = within(row.variable, isLog && isWhole ? Math.round(value) : tidy(value));
    showValue(tidied);
    send(tidied);
  }
  const scrub = (steps) => change(row.variable.value + steps * step);
  return { inputs: [slider, field], showValue, scrub };
}

function switchInput(row, send) {
  const box = h("input", { type: "checkbox", onchange: () => send(box.checked) });
  box.setAttribute("aria-label", row.variable.name);
  const showValue = (value) => (box.checked = value);
  return { inputs: [h("label.switch", {}, box, h("span", {}))], showValue };
}

function choiceInput(row, send) {
  const { name, choices } = row.variable;
  const options = choices.map((choice, index) => h("option", { value: String(index) }, String(choice)));
  const list = h("select", { onchange: () => send(choices[Number(list.value)]) }, ...options);
  list.setAttribute("aria-label", name);
  const showValue = (value) => (list.value = String(choices.indexOf(value)));
  return { inputs: [list], showValue };
}

function textInput(row, send) {
  const field = h("input", { type: "text", spellcheck: false, onchange: () => send(field.value) });
  field.setAttribute("aria-label", row.variable.name);
  const showValue = (value) => {
    if (document.activeElement !== field) field.value = value;
  };
  return { inputs: [field], showValue };
}

/** Let a label be dragged to the left and right to change a number. */
function followScrub(label, scrub) {
  label.classList.add("scrub");
  label.addEventListener("pointerdown", (event) => {
    let last = event.clientX;
    label.setPointerCapture(event.pointerId);
    label.onpointermove = (move) => {
      const steps = Math.trunc((move.clientX - last) / SCRUB_PIXELS);
      if (!steps) return;
      last += steps * SCRUB_PIXELS;
      scrub(steps);
    };
    label.onpointerup = label.onpointercancel = () => (label.onpointermove = null);
  });
}

/** Return a step that suits how a number is written: 0.133 goes by 0.001. */
function stepOf(value, isWhole) {
  if (isWhole) return value === 0 ? 0.1 : 1;
  const digits = (String(value).split(".")[1] ?? "").length;
  return 10 ** -Math.max(Math.min(digits, 6), 1);
}

/** Return the ends of a slider: those the file gives, and what suits the default for the others. */
function rangeOf({ default: value, isWhole, least, most }) {
  const [low, high] = guessedRange(value, isWhole);
  if (least === undefined) return [Math.min(low, most ?? low), most ?? high];
  return [least, most ?? Math.max(high, least + Math.abs(least || 1))];
}

function guessedRange(value, isWhole) {
  if (value === 0) return isWhole ? [0, 1] : [-1, 1];
  const far = isWhole ? Math.max(2 * Math.abs(value), 10) : 2 * Math.abs(value);
  return value > 0 ? [0, far] : [-far, 0];
}

const within = ({ least, most }, value) => Math.min(Math.max(value, least ?? -Infinity), most ?? Infinity);

const tidy = (value) => Number(value.toPrecision(6));

/** Return a text as YAML that cannot be taken for a number or anything else. */
const quoted = (text) => (/^[A-Za-z][\w ./-]*$/.test(text) ? text : JSON.stringify(text));

function shellWord(name, value) {
  const word = `${name}:=${value}`;
  return /^[\w.:=+/-]*$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`;
}
