// Light, dark, or as the system is.

import { followSetting, keep, recall } from "./settings.js";

const THEMES = ["auto", "light", "dark"];

export class Theme {
  /** @param {(shown: string, chosen: string) => void} onChange takes the colours to use, now and later */
  constructor(onChange) {
    this.onChange = onChange;
    this.outer = null;
    this.system = window.matchMedia("(prefers-color-scheme: dark)");
    this.system.addEventListener("change", () => this.apply());
    window.addEventListener("message", (event) => this.hear(event));
    followSetting("theme", (theme) => this.set(theme));
    window.addEventListener("hashchange", () => this.set(recall("theme")));
    this.set(recall("theme"));
  }

  /** An editor around the page tells its colours, which go before those of the system. */
  hear({ source, data }) {
    if (source !== window.parent || data?.type !== "yamaro.theme") return;
    this.outer = data.theme === "dark" ? "dark" : "light";
    this.apply();
  }

  /** Use one of `THEMES`. */
  set(theme) {
    this.chosen = THEMES.includes(theme) ? theme : "auto";
    this.apply();
  }

  /** Go on to the next of `THEMES`, and keep it. */
  next() {
    this.set(THEMES[(THEMES.indexOf(this.chosen) + 1) % THEMES.length]);
    keep("theme", this.chosen);
  }

  /** The colours in use: "light" or "dark". */
  get shown() {
    if (this.chosen !== "auto") return this.chosen;
    return this.outer ?? (this.system.matches ? "dark" : "light");
  }

  apply() {
    document.documentElement.dataset.theme = this.outer ? this.shown : this.chosen;
    this.onChange(this.shown, this.chosen);
  }
}
