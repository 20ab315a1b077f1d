// Light or dark: the system's choice until somebody presses the button.
"use strict";

const Theme = {
  listeners: [],
  dark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  },
  toggle() {
    document.documentElement.dataset.theme = Theme.dark() ? "light" : "dark";
    Theme.changed();
  },
  changed() { for (const listener of Theme.listeners) listener(); },
  /** Gives a three.js material a palette colour; lights and blending work on linear colours. */
  paint(material, name) {
    material.color.set(Theme.colour(name)).convertSRGBToLinear();
  },
  /** Value of a CSS colour variable, as "#rrggbb". */
  colour(name) { return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim(); },
};
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => Theme.changed());
