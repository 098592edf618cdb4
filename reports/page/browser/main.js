import { sortableTables } from "./sort_tables.js";
import { themeSwitch } from "./theme.js";
import { Viewer } from "./viewer.js";

themeSwitch(document.querySelector("header"));
sortableTables(document);

const index = document.getElementById("viewer-index");
if (index) {
  const place = document.getElementById("viewer-place");
  const viewer = new Viewer(place, JSON.parse(index.textContent));
  viewer.start();
  window.fracbenchViewer = viewer; // for the browser's console, and for tests
  for (const row of document.querySelectorAll("tr[data-cell]")) {
    const button = document.createElement("button");
    button.textContent = "look";
    button.addEventListener("click", () => {
      viewer.show(row.dataset.cell);
      document.getElementById("viewer").scrollIntoView();
    });
    row.lastElementChild.prepend(button, " ");
  }
}
