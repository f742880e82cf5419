// Light, dark, or as the system is.

import { followSetting, keep, recall } from "./settings.js";

const THEMES = ["auto", "light", "dark"];

export class Theme {
  /** @param {(shown: string, chosen: string) => void} onChange takes the colours to use, now and later */
  constructor(onChange) {
    this.onChange = onChange;
    this.system = window.matchMedia("(prefers-color-scheme: dark)");
    this.system.addEventListener("change", () => this.apply());
    followSetting("theme", (theme) => this.set(theme));
    window.addEventListener("hashchange", () => this.set(recall("theme")));
    this.set(recall("theme"));
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
    return this.system.matches ? "dark" : "light";
  }

  apply() {
    document.documentElement.dataset.theme = this.chosen;
    this.onChange(this.shown, this.chosen);
  }
}
