import { sortableTables } from "./sort_tables.js";
import { themeSwitch } from "./theme.js";
import { Viewer } from "./viewer.js";

themeSwitch(document.querySelector("header"));
sortableTables(document);

function startViewer(index) {
  const place = document.getElementById("viewer-place");
  const viewer = new Viewer(place, JSON.parse(index.textContent));
  viewer.start();
  window.fracbenchViewer = viewer; // for the browser's console, and for tests
  const look = (key) => {
    viewer.show(key);
    document.getElementById("viewer").scrollIntoView();
  };
  for (const figure of document.querySelectorAll("figure[data-cell]")) {
    figure.setAttribute("role", "button");
    figure.tabIndex = 0;
    figure.addEventListener("click", () => look(figure.dataset.cell));
    figure.addEventListener("keydown", (event) => {
      if (event.key === "Enter") look(figure.dataset.cell);
    });
  }
  for (const row of document.querySelectorAll("tr[data-cell]")) {
    const button = document.createElement("button");
    button.textContent = "look";
    button.addEventListener("click", () => look(row.dataset.cell));
    row.lastElementChild.prepend(button, " ");
  }
}

// The page can be read before the viewer is there, which takes a second where pixels are computed
// by the processor.
const index = document.getElementById("viewer-index");
if (index) addEventListener("load", () => setTimeout(() => startViewer(index)));
