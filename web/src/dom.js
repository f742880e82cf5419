// Makes elements of the page. Text is always set as text, never as markup.

/** Return the element with an id. */
export const byId = (id) => document.getElementById(id);

/**
 * Make an element.
 * @param {string} tag its name, with classes as in `div.row.wide`
 * @param {object} [properties] properties, listeners (`onclick`), `data` and `aria` as objects
 * @param {...(Node|string|null|false)} children what goes into it; null and false are left out
 */
export function h(tag, properties = {}, ...children) {
  const [name, ...classes] = tag.split(".");
  const element = document.createElement(name);
  if (classes.length) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(properties)) {
    if (key === "data") Object.assign(element.dataset, value);
    else if (key === "aria") {
      for (const [aspect, text] of Object.entries(value)) {
        element.setAttribute(`aria-${aspect}`, String(text));
      }
    } else element[key] = value;
  }
  element.append(...children.filter((child) => child !== null && child !== false));
  return element;
}

/** Show or hide an element. */
export function show(element, isShown) {
  element.hidden = !isShown;
}

/** Call a function once in the next frame, however often it is asked for until then. */
export function oncePerFrame(action) {
  let isWaiting = false;
  return () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(() => {
      isWaiting = false;
      action();
    });
  };
}
