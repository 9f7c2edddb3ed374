"use strict";
/* Filters and sorts the table of a page. Without it the page shows everything, in the order of names. */
(() => {
  const table = document.getElementById("matrix");
  const form = document.querySelector(".filter");
  if (!table || !form) { return; }
  const body = table.tBodies[0];
  let rows = [...body.rows].map((row, place) => ({
    row, place, shown: !row.hidden,
    text: row.textContent.toLowerCase(),
    old: "old" in row.dataset,
    broken: "broken" in row.dataset,
    cells: [...row.cells].filter((cell) => cell.dataset.verdict).map((cell) => cell.dataset),
  }));
  const $ = (id) => document.getElementById(id);
  const choices = ["profile", "verdict", "assurance"].map($).filter(Boolean);
  const boxes = ["newest", "broken"].map($).filter(Boolean);
  const search = $("search"), shown = $("shown"), nothing = document.querySelector(".nothing");

  // what fits on screens comes back at once, and the rest of long tables bit by bit: laying out all rows takes long
  const AT_ONCE = 60;
  let waiting = [], timer = 0;
  const reveal = (number) => {
    clearTimeout(timer);
    for (const one of waiting.splice(0, number)) { one.row.hidden = false; one.shown = true; }
    if (waiting.length) { table.setAttribute("aria-busy", "true"); timer = setTimeout(reveal, 0, 500); } else { table.removeAttribute("aria-busy"); }
  };
  addEventListener("beforeprint", () => reveal(Infinity));

  const apply = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const wanted = choices.filter((choice) => choice.value).map((choice) => [choice.id, choice.value]);
    const newest = $("newest") && $("newest").checked, broken = $("broken") && $("broken").checked;
    let count = 0;
    waiting = [];
    for (const one of rows) {
      const fits = !(newest && one.old) && !(broken && !one.broken)
        && words.every((word) => one.text.includes(word))
        && (!wanted.length || one.cells.some((cell) => wanted.every(([key, value]) => cell[key] === value)));
      if (!fits && one.shown) { one.row.hidden = true; one.shown = false; }
      if (fits && !one.shown) { waiting.push(one); }
      count += fits ? 1 : 0;
    }
    reveal(AT_ONCE);
    shown.textContent = count === rows.length ? `${count} shown` : `${count} of ${rows.length} shown`;
    nothing.hidden = count > 0;
    table.hidden = count === 0;
    const state = new URLSearchParams();
    if (search.value) { state.set("search", search.value); }
    wanted.forEach(([key, value]) => state.set(key, value));
    boxes.filter((box) => box.checked).forEach((box) => state.set(box.id, "1"));
    const hash = String(state);
    if (hash || location.hash.includes("=")) { history.replaceState(null, "", hash ? "#" + hash : location.pathname); }
  };

  const RANK = { "conformant": 0, "inconclusive": 1, "not conformant": 2, "other rules": 3 };
  const key = (row, column, kind) => {
    const cell = row.cells[column];
    if (kind === "verdict") { return cell.dataset.verdict ? RANK[cell.dataset.verdict] : 9; }
    return kind === "number" ? -Number(cell.textContent) : cell.textContent.trim().toLowerCase();
  };
  const sort = (head, way) => {
    const keyed = rows.map((one) => [key(one.row, head.cellIndex, head.dataset.sort), one]);
    keyed.sort(([a, one], [b, other]) => (a < b ? -way : a > b ? way : one.place - other.place));
    rows = keyed.map(([, one]) => one);
    body.append(...rows.map((one) => one.row));
    for (const other of table.tHead.rows[0].cells) { other.removeAttribute("aria-sort"); }
    head.setAttribute("aria-sort", way > 0 ? "ascending" : "descending");
  };
  for (const head of table.tHead.rows[0].cells) {
    if (!head.dataset.sort) { continue; }
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    button.addEventListener("click", () => sort(head, head.getAttribute("aria-sort") === "ascending" ? -1 : 1));
    head.replaceChildren(button);
  }

  form.hidden = false;
  form.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => setTimeout(apply));
  $("clear").addEventListener("click", () => { form.reset(); search.focus(); });
  const restore = () => {
    const state = new URLSearchParams(location.hash.slice(1));
    search.value = state.get("search") || "";
    choices.forEach((choice) => { choice.value = state.get(choice.id) || ""; if (choice.selectedIndex < 0) { choice.value = ""; } });
    boxes.forEach((box) => { box.checked = state.has(box.id); });
    apply();
  };
  addEventListener("hashchange", () => { if (location.hash.includes("=") || !location.hash) { restore(); } });
  addEventListener("keydown", (event) => {
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(document.activeElement.tagName);
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) { event.preventDefault(); search.focus(); }
    if (event.key === "Escape" && document.activeElement === search) { search.value = ""; apply(); }
  });
  if (location.hash.includes("=")) { restore(); } else { apply(); }
})();
