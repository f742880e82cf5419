// What the user wrote, kept while the tab is open, so that a reload of the page does not lose it.

const KEY = "yamaro.playground";

/** Keep the files of the page at this address. */
export function remember(project) {
  try {
    sessionStorage.setItem(KEY, JSON.stringify({ ...project, address: location.href }));
  } catch {
    // The browser keeps nothing, or not as much.
  }
}

/** Return what was kept if the page was reloaded, or null. */
export function recall() {
  if (performance.getEntriesByType("navigation")[0]?.type !== "reload") return null;
  try {
    const { address, ...project } = JSON.parse(sessionStorage.getItem(KEY)) ?? {};
    return address === location.href ? project : null;
  } catch {
    return null;
  }
}
