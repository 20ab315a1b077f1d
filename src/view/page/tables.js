// Tables that sort by a click on a heading, and long ones that can be searched.
"use strict";

const kSearchable = 12;  // rows

/** The number that a cell begins with ("12/60", "3.2 s"), infinity for "unsolved", or null for text. */
function numberOf(text) {
  if (text === "" || text === "-") return NaN;
  if (text === "unsolved") return Infinity;
  const found = /^[-+]?[0-9]*\.?[0-9]+(e[-+]?[0-9]+)?(?![a-z0-9_])/i.exec(text);
  return found ? Number(found[0]) : null;
}

function makeSortable(table) {
  const body = table.tBodies[0], headings = [...table.tHead.rows[0].cells], rows = [...body.rows];
  const texts = rows.map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
  headings.forEach((heading, column) => {
    const numbers = texts.map((row) => numberOf(row[column]));
    const numeric = numbers.every((value) => value !== null) && numbers.some((value) => !Number.isNaN(value));
    const button = document.createElement("button");
    button.textContent = heading.textContent;
    heading.replaceChildren(button);
    if (numeric) for (const row of [heading, ...rows.map((r) => r.cells[column])]) row.classList.add("number");
    rows.forEach((row, i) => { if (texts[i][column].length > 48) row.cells[column].classList.add("long"); });
    button.addEventListener("click", () => {
      const down = heading.getAttribute("aria-sort") === "ascending";
      for (const other of headings) other.removeAttribute("aria-sort");
      heading.setAttribute("aria-sort", down ? "descending" : "ascending");
      const order = rows.map((_, i) => i);
      order.sort((a, b) => {
        if (!numeric) return (down ? -1 : 1) * texts[a][column].localeCompare(texts[b][column], undefined, {numeric: true});
        const x = numbers[a], y = numbers[b];
        if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);  // no value comes last
        return x === y ? 0 : (x < y ? -1 : 1) * (down ? -1 : 1);
      });
      body.append(...order.map((i) => rows[i]));
    });
  });
  if (rows.length >= kSearchable) addSearch(table, rows, texts);
}

function addSearch(table, rows, texts) {
  const field = document.createElement("input");
  field.type = "search";
  field.className = "search";
  field.placeholder = "find in this table";
  const whole = texts.map((row) => row.join(" ").toLowerCase());
  field.addEventListener("input", () => {
    const words = field.value.toLowerCase().split(/\s+/);
    rows.forEach((row, i) => { row.hidden = !words.every((word) => whole[i].includes(word)); });
  });
  table.parentElement.before(field);
}

for (const table of document.querySelectorAll("table.data")) makeSortable(table);
document.getElementById("theme").addEventListener("click", () => Theme.toggle());
addEventListener("keydown", (event) => {
  if (event.key === "t" && !event.target.closest("input") && !event.ctrlKey && !event.metaKey && !event.altKey) Theme.toggle();
});
