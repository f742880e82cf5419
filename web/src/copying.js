// Copies texts. Where the browser does not allow that, as in frames, the text is shown to be copied.

import { h } from "./dom.js";

/**
 * Copy a text.
 * @returns {Promise<boolean>} whether it is copied; otherwise it is shown, selected
 */
export async function copy(text) {
  if (await written(text)) return true;
  showText(text);
  return false;
}

async function written(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return writtenByCommand(text);
  }
}

/** Copy in the way of old browsers, which frames may still allow. */
function writtenByCommand(text) {
  const before = document.activeElement;
  const field = h("textarea.unseen", { value: text, readOnly: true });
  document.body.append(field);
  field.select();
  let isDone = false;
  try {
    isDone = document.execCommand("copy");
  } catch {
    // The text is shown instead.
  }
  field.remove();
  before?.focus?.();
  return isDone;
}

function showText(text) {
  const field = h("textarea", { value: text, readOnly: true, rows: Math.min(text.split("\n").length, 12) });
  field.setAttribute("aria-label", "Text to copy");
  const close = h("button.primary", { type: "button", onclick: () => card.close() }, "Close");
  const card = h(
    "dialog.copy-card",
    { onclose: () => card.remove() },
    h("p", {}, "This page may not copy here. Copy the text with Ctrl+C:"),
    field,
    close,
  );
  document.body.append(card);
  card.showModal();
  field.select();
}
