/* The interactive part of the page: legend entries show and hide their series, values appear beside the pointer and the focus, pictures of
   successive times play. Without it every drawing is there, and its values are the titles of its marks. */
"use strict";
(() => {
const each = (root, what, act) => root.querySelectorAll(what).forEach(act);
const tip = document.createElement("div");
tip.id = "tip";
tip.hidden = true;
tip.setAttribute("role", "status");
document.body.append(tip);
const spot = document.createElementNS("http://www.w3.org/2000/svg", "circle");
spot.setAttribute("class", "spot");
spot.setAttribute("r", 5);

function hide() {
  tip.hidden = true;
  spot.remove();
}

function show(text, x, y) {
  tip.textContent = text.replaceAll("; ", "\n");
  tip.hidden = false;
  const box = tip.getBoundingClientRect(), width = document.documentElement.clientWidth;
  tip.style.left = Math.max(4, Math.min(x + 14, width - box.width - 4)) + "px";
  tip.style.top = (y - box.height - 12 < 4 ? y + 16 : y - box.height - 12) + "px";
}

/* ---- legend ---- */

function toggle(entry) {
  const figure = entry.closest("figure"), on = entry.getAttribute("aria-pressed") !== "true";
  each(figure, `.entry[data-key="${entry.dataset.key}"]`, e => e.setAttribute("aria-pressed", on));
  each(figure, `.series[data-key="${entry.dataset.key}"]`, s => s.classList.toggle("off", !on));
  hide();
}

function makeButton(entry) {
  entry.setAttribute("role", "button");
  entry.setAttribute("tabindex", 0);
  entry.setAttribute("aria-pressed", true);
  entry.addEventListener("click", () => toggle(entry));
  entry.addEventListener("keydown", event => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    toggle(entry);
  });
}

/* ---- values of marks ---- */

/* The title of an element becomes ours to show; the browser's own would cover it. */
function titleOf(element) {
  const title = element.querySelector(":scope > title");
  if (title) {
    element.dataset.tip = title.textContent;
    element.setAttribute("aria-label", title.textContent);
    title.remove();
  }
  return element.dataset.tip;
}

function showOf(element) {
  const box = element.getBoundingClientRect();
  show(titleOf(element), box.left + box.width / 2, box.top + box.height / 2);
}

/* One stop of the Tab key a drawing; the arrows go from mark to mark. */
function makeMarks(svg) {
  const marks = [...svg.querySelectorAll(".mark,.band")];
  marks.forEach((mark, i) => {
    mark.setAttribute("tabindex", i ? -1 : 0);
    mark.setAttribute("role", "img");
    titleOf(mark);
    mark.addEventListener("focus", () => showOf(mark));
    mark.addEventListener("blur", hide);
    mark.addEventListener("keydown", event => {
      const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
      if (event.key === "Escape") hide();
      if (!step) return;
      event.preventDefault();
      const seen = marks.filter(m => !m.closest(".off"));
      const next = seen[seen.indexOf(mark) + step];
      if (!next) return;
      mark.setAttribute("tabindex", -1);
      next.setAttribute("tabindex", 0);
      next.focus();
    });
  });
}

/* ---- values of lines ---- */

function valueAt(axis, place) {
  const [kind, low, high, from, to] = axis.split(" ").map((t, i) => i ? Number(t) : t);
  const part = (place - from) / (to - from);
  const value = kind === "log" ? low * (high / low) ** part : low + part * (high - low);
  if (Math.abs(value) < (high - low) * 1e-3 && kind !== "log") return "0";
  return String(Number(value.toPrecision(3))).replace("e+", "e");
}

/* Corners of a path of ours: M, L, V and H, all absolute. */
const corners = new WeakMap();
function cornersOf(path) {
  if (!corners.has(path)) {
    const list = [];
    let x = 0, y = 0;
    for (const [, command, rest] of path.getAttribute("d").matchAll(/([MLVH])([^MLVH]*)/g)) {
      const number = rest.trim().split(/[ ,]+/).map(Number);
      if (command === "V") y = number[0];
      else if (command === "H") x = number[0];
      else [x, y] = number;
      list.push([x, y]);
    }
    corners.set(path, list);
  }
  return corners.get(path);
}

/* The place on the path that is nearest to (x, y), and its distance. */
function nearestOn(path, x, y) {
  const list = cornersOf(path);
  let best = {distance: Infinity};
  for (let i = 0; i < list.length; i++) {
    const [ax, ay] = list[Math.max(0, i - 1)], dx = list[i][0] - ax, dy = list[i][1] - ay;
    const t = dx || dy ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy))) : 0;
    const px = ax + t * dx, py = ay + t * dy, distance = Math.hypot(x - px, y - py);
    if (distance < best.distance) best = {path, x: px, y: py, distance};
  }
  return best;
}

function lineAt(panel, x, y) {
  let best = {distance: 14};
  each(panel, ".series:not(.off) > .line", path => {
    const found = nearestOn(path, x, y);
    if (found.distance < best.distance) best = found;
  });
  return best;
}

function showLine(panel, found, event) {
  const name = titleOf(found.path), of = panel.dataset;
  const text = (of.x.startsWith("names") ? "" : `${of.xLabel}: ${valueAt(of.x, found.x)}; `) + `${of.yLabel}: ${valueAt(of.y, found.y)}`;
  spot.setAttribute("cx", found.x);
  spot.setAttribute("cy", found.y);
  panel.append(spot);
  show((name ? name + "; " : "") + text, event.clientX, event.clientY);
}

function follow(svg, event) {
  const over = event.target.closest("[data-tip]") || event.target;
  if (!over.matches(".line") && titleOf(over)) {
    hide();
    show(titleOf(over), event.clientX, event.clientY);
    return;
  }
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  for (const panel of svg.querySelectorAll(".panel[data-y]")) {
    const [from, to] = panel.dataset.y.split(" ").slice(3).map(Number), [left, right] = panel.dataset.x.split(" ").slice(3).map(Number);
    if (at.y > from + 4 || at.y < to - 4 || at.x < left - 12 || at.x > right + 12) continue;
    const found = lineAt(panel, at.x, at.y);
    if (!found.path) break;
    showLine(panel, found, event);
    return;
  }
  hide();
}

each(document, "figure svg.chart", svg => {
  svg.setAttribute("role", "group"); /* of things that can be reached, no longer one image */
  each(svg, ".entry", makeButton);
  makeMarks(svg);
  svg.addEventListener("pointermove", event => follow(svg, event));
  svg.addEventListener("pointerleave", hide);
});
addEventListener("scroll", () => {
  if (!document.activeElement.matches(".mark,.band")) hide(); /* the focus itself may scroll */
}, {passive: true});
})();
