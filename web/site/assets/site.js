// What the theme leaves out for those who use the keyboard or hear the pages.

/** Let what scrolls be scrolled with the keyboard; name copy buttons apart; make headers headers. */
function mend() {
  for (const part of document.querySelectorAll(".md-typeset__scrollwrap, .md-typeset pre > code")) {
    if (part.scrollWidth > part.clientWidth || part.scrollHeight > part.clientHeight) part.tabIndex = 0;
    else part.removeAttribute("tabindex");
  }
  document.querySelectorAll(".md-code__nav").forEach((nav, index) => {
    nav.setAttribute("aria-label", `Example ${index + 1}`);
  });
  // Markdown has no table without a header, but a cell in it may be empty.
  for (const cell of document.querySelectorAll("th:empty")) cell.replaceWith(document.createElement("td"));
}

// The theme changes the page when it starts, and tables become narrower with the window.
new MutationObserver(mend).observe(document.body, { childList: true, subtree: true });
window.addEventListener("resize", mend);
mend();

/** Go on to the chapter that has a place, from the page that had all chapters. */
function goOn() {
  if (!location.hash || document.getElementById(decodeURIComponent(location.hash.slice(1)))) return;
  for (const link of document.querySelectorAll(".chapters a")) {
    if (link.hash === location.hash) return location.replace(link.href);
  }
}

window.addEventListener("hashchange", goOn);
goOn();
