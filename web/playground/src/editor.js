// The editor: one CodeMirror, with the state of each file.

import { indentWithTab } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import { xml } from "@codemirror/lang-xml";
import { yaml } from "@codemirror/lang-yaml";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { Decoration, EditorView, keymap, MatchDecorator, ViewPlugin } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { basicSetup } from "codemirror";

const style = HighlightStyle.define([
  { tag: [tags.propertyName, tags.definition(tags.propertyName), tags.tagName], class: "tok-key" },
  { tag: [tags.string, tags.attributeValue], class: "tok-string" },
  { tag: [tags.number, tags.bool, tags.null], class: "tok-number" },
  { tag: [tags.comment, tags.lineComment, tags.blockComment], class: "tok-comment" },
  { tag: [tags.keyword, tags.controlKeyword, tags.definitionKeyword], class: "tok-keyword" },
  { tag: [tags.attributeName], class: "tok-attribute" },
  { tag: [tags.angleBracket, tags.punctuation, tags.separator], class: "tok-mark" },
]);

/** `$(…)` on one line, brackets in it included, and the words that are statements. */
const marks = new MatchDecorator({
  regexp: /\$\((?:[^()\n]|\([^()\n]*\))*\)|^\s*-?\s*(?:robot|model|variables|functions|arguments|import|include|for|if|elif|else|part|process|print|groups|states|frames)(?=[ :])/g,
  decoration: (match) => Decoration.mark({ class: match[0].startsWith("$") ? "tok-expression" : "tok-keyword" }),
});
const expressions = ViewPlugin.define((view) => {
  const plugin = { decorations: marks.createDeco(view) };
  plugin.update = (update) => {
    plugin.decorations = marks.updateDeco(update, plugin.decorations);
  };
  return plugin;
}, { decorations: (plugin) => plugin.decorations });

function languageOf(name) {
  if (name.endsWith(".py")) return [python()];
  return /\.(ya?ml)$/.test(name) ? [yaml(), expressions] : [xml()];
}

/** What is wrong, what to write, and the code, which leads to the page of the manual on it. */
function explained(one) {
  const code = document.createElement("a");
  Object.assign(code, { href: one.page, target: "_blank", textContent: one.code });
  const text = document.createElement("div");
  text.append(one.hint ? `${one.message}\n${one.hint}\n` : `${one.message}\n`, code);
  return text;
}

export class Editor {
  /**
   * @param {HTMLElement} parent
   * @param {object} told `onChange(name, text)`, `onCursor(name, line)`, `onFix(edits)`
   */
  constructor(parent, told) {
    this.told = told;
    this.states = new Map();
    this.active = null;
    this.view = new EditorView({ parent });
  }

  /** Take files in place of those before, and show one. */
  open(files, active) {
    this.states = new Map(Object.entries(files).map(([name, text]) => [name, this.makeState(name, text)]));
    this.active = null;
    this.show(active);
  }

  makeState(name, text) {
    const listener = EditorView.updateListener.of((update) => {
      if (update.docChanged && this.active === name) this.told.onChange(name, update.state.doc.toString());
      if (update.selectionSet && this.active === name) {
        this.told.onCursor(name, update.state.doc.lineAt(update.state.selection.main.head).number);
      }
    });
    const label = EditorView.contentAttributes.of({ "aria-label": `The text of ${name}`, tabindex: "0" });
    return EditorState.create({
      doc: text,
      extensions: [
        basicSetup,
        keymap.of([indentWithTab]),
        ...languageOf(name),
        syntaxHighlighting(style),
        lintGutter(),
        listener,
        label,
      ],
    });
  }

  show(name) {
    if (this.active !== null) this.states.set(this.active, this.view.state);
    this.active = name;
    this.view.setState(this.states.get(name));
  }

  add(name, text) {
    this.states.set(name, this.makeState(name, text));
  }

  /** Call a file by another name, with the language of that. */
  rename(name, other) {
    const texts = this.texts();
    this.states = new Map([...this.states].map(([each, state]) => [each === name ? other : each, state]));
    this.states.set(other, this.makeState(other, texts[name]));
    if (this.active !== name) return;
    this.active = null;
    this.show(other);
  }

  remove(name) {
    this.states.delete(name);
    if (this.active === name) this.active = null;
  }

  texts() {
    const states = new Map(this.states);
    if (this.active !== null) states.set(this.active, this.view.state);
    return Object.fromEntries([...states].map(([name, state]) => [name, state.doc.toString()]));
  }

  /** Underline what is wrong. */
  mark(diagnostics) {
    if (this.active === null) return;
    const length = this.view.state.doc.length;
    const shown = diagnostics
      .filter(({ file }) => file === this.active)
      .map((one) => ({
        from: Math.min(one.from, length),
        to: Math.min(Math.max(one.to, one.from), length),
        severity: one.severity,
        message: one.hint ? `${one.message}\n${one.hint}` : one.message,
        renderMessage: () => explained(one),
        actions: one.fix ? [{ name: one.fix.title, apply: () => this.told.onFix(one.fix.edits) }] : [],
      }));
    this.view.dispatch(setDiagnostics(this.view.state, shown));
  }

  /** Change the files as a fix says. */
  apply(edits) {
    for (const name of new Set(edits.map(({ file }) => file))) {
      if (!this.states.has(name)) continue;
      this.show(name);
      const changes = edits.filter(({ file }) => file === name);
      this.view.dispatch({ changes: changes.map(({ from, to, insert }) => ({ from, to, insert })) });
    }
  }

  goTo(line, column) {
    const place = this.view.state.doc.line(Math.min(Math.max(line, 1), this.view.state.doc.lines));
    const at = Math.min(place.from + Math.max(column - 1, 0), place.to);
    this.view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
    this.view.focus();
  }
}

/** An editor that only shows. */
export class Output {
  constructor(parent) {
    this.view = new EditorView({ parent });
    this.show("", "The robot in the chosen format");
  }

  show(text, label) {
    this.view.setState(
      EditorState.create({
        doc: text,
        extensions: [
          basicSetup,
          xml(),
          syntaxHighlighting(style),
          EditorState.readOnly.of(true),
          EditorView.contentAttributes.of({ "aria-label": label, tabindex: "0" }),
        ],
      }),
    );
  }
}
