// One script for two pages, which share nearly all of it: `yamaro view`, and a robot in a notebook.

if (document.body.dataset.page === "notebook") import("./notebook.js");
else import("./main.js");
