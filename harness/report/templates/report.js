"use strict";
(() => {
  const items = [...document.querySelectorAll(".item")];
  const list = document.querySelector(".list");
  const filter = document.querySelector(".filter");
  const search = document.getElementById("search");
  const shown = document.getElementById("shown");
  const help = document.getElementById("help");
  const boxes = [...filter.querySelectorAll("input[type=checkbox]")];
  const words = new Map(items.map((item) => [item, item.querySelector(".head").textContent.toLowerCase()]));
  let at = null;

  const toggle = (item, open = !item.classList.contains("open")) => {
    item.classList.toggle("open", open);
    item.querySelector("details").open = open;
    item.querySelector(".title button").setAttribute("aria-expanded", String(open));
  };

  for (const item of items) {
    const title = item.querySelector(".title");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = title.textContent;
    button.setAttribute("aria-expanded", "false");
    title.replaceChildren(button);
    item.querySelector(".head").addEventListener("click", () => {
      if (!String(getSelection())) { toggle(item); }
    });
  }
  list.classList.add("live");
  filter.hidden = false;

  const apply = () => {
    const wanted = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const verdicts = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
    let count = 0;
    for (const item of items) {
      const fits = verdicts.has(item.dataset.verdict) && wanted.every((word) => words.get(item).includes(word));
      item.hidden = !fits;
      count += fits ? 1 : 0;
    }
    shown.textContent = count === items.length ? `${count} requirements` : `${count} of ${items.length} requirements`;
  };
  search.addEventListener("input", apply);
  boxes.forEach((box) => box.addEventListener("change", apply));

  const visit = (item) => {
    if (!item) { return; }
    if (at) { at.classList.remove("at"); }
    at = item;
    at.classList.add("at");
    at.querySelector(".title button").focus({ preventScroll: true });
    at.scrollIntoView({ block: "nearest" });
  };
  const move = (way, fits = () => true) => {
    const open = items.filter((item) => !item.hidden && (item === at || fits(item)));
    const index = open.indexOf(at);
    const next = index < 0 ? (way > 0 ? open[0] : open[open.length - 1]) : open[index + way];
    visit(next && next.hidden ? null : next);
  };

  const arrive = () => {
    const item = items.find((one) => "#" + one.id === decodeURIComponent(location.hash));
    if (!item) { return; }
    if (item.hidden) { search.value = ""; boxes.forEach((box) => { box.checked = true; }); apply(); }
    toggle(item, true);
    visit(item);
    item.scrollIntoView({ block: "start" });
  };
  addEventListener("hashchange", arrive);
  document.addEventListener("click", (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link && link.getAttribute("href") === location.hash) { arrive(); }
  });
  document.getElementById("help-button").addEventListener("click", () => help.showModal());

  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || help.open) { return; }
    if (event.target === search) {
      if (event.key === "Escape") { search.value = ""; apply(); search.blur(); }
      if (event.key === "Enter") { move(1); event.preventDefault(); }
      return;
    }
    const acts = {
      "/": () => { search.focus(); search.select(); },
      "?": () => help.showModal(),
      j: () => move(1),
      k: () => move(-1),
      f: () => move(1, (item) => item.dataset.verdict === "fail"),
    };
    if (acts[event.key]) { event.preventDefault(); acts[event.key](); }
  });

  addEventListener("beforeprint", () => items.filter((item) => item.dataset.verdict === "fail").forEach((item) => toggle(item, true)));
  apply();
  arrive();
})();
