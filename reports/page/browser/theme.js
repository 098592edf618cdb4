// Light or dark: as the system says, until the reader says otherwise.

const order = ["auto", "light", "dark"];
const store = "fracbench-theme";

function stored() {
  try {
    return localStorage.getItem(store) ?? "auto";
  } catch {
    return "auto"; // pages from a disk may have no storage
  }
}

export function themeSwitch(place) {
  const button = document.createElement("button");
  button.className = "theme";
  const apply = (theme) => {
    document.documentElement.dataset.theme = theme;
    button.textContent = `theme: ${theme}`;
    try {
      localStorage.setItem(store, theme);
    } catch {
      // Then it is chosen anew on the next page.
    }
  };
  apply(stored());
  button.addEventListener("click", () => {
    const current = order.indexOf(document.documentElement.dataset.theme);
    apply(order[(current + 1) % order.length]);
  });
  place.append(button);
}
