// What the user has chosen, kept by the browser. A setting in the address goes first: `#theme=dark`.

const PREFIX = "yamaro.";

/** Return a setting, or null. */
export function recall(name) {
  const given = new URLSearchParams(location.hash.slice(1)).get(name);
  if (given !== null) return given;
  try {
    return localStorage.getItem(PREFIX + name);
  } catch {
    return null; // a frame may have no storage
  }
}

/** Keep a setting, as far as the browser lets us. */
export function keep(name, value) {
  try {
    localStorage.setItem(PREFIX + name, value);
  } catch {
    // It lasts as long as the page.
  }
}

/** Call a function when another page of this address has changed a setting. */
export function followSetting(name, onChange) {
  window.addEventListener("storage", ({ key, newValue }) => {
    if (key === PREFIX + name && newValue !== null) onChange(newValue);
  });
}
