// The page: the list of what is not as blessed, grouped by cause and the worst first, and all that is known of one case.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const find = (selector) => document.querySelector(selector);
const words = { different: "different", incomparable: "not compared", tolerated: "tolerated", same: "same" };

function element(tag, properties = {}, ...children) {
  const result = Object.assign(document.createElement(tag), properties);
  result.append(...children);
  return result;
}

function percent(share) {
  const value = 100 * share;
  return `${value >= 10 ? Math.round(value) : Number(value.toPrecision(2))} %`;
}
function count(n, one, many = one + "s") { return `${n} ${n === 1 ? one : many}`; }

// Names may break after what joins their words.
function breakable(name) { return name.replace(/[_\/]/g, "$&\u200b"); }

// How bad a case is: what a person sees of it, then how many pixels differ.
function isWorse(one, other) { return (other.flip ?? 2) - (one.flip ?? 2) || other.differing - one.differing; }

// Why nothing is known of a frame, without what is its own: names and numbers.
function reasonOf(why) {
  return why.startsWith("is ") ? "another size, or another kind of picture" : why.replace(/\(.*|[/\d].*$/, "").trim();
}

// Cases that have one cause: the first target that differs; of those without a picture to compare, why.
function groups() {
  const result = new Map();
  for (const entry of data.cases) {
    const cause = entry.outcome === "incomparable" ? reasonOf(entry.why) : entry.first;
    const key = `${entry.outcome} ${cause}`;
    if (!result.has(key)) result.set(key, { outcome: entry.outcome, cause, cases: [] });
    result.get(key).cases.push(entry);
  }
  const order = ["incomparable", "different", "tolerated"];
  const sorted = [...result.values()];
  for (const group of sorted) group.cases.sort(isWorse);
  return sorted.sort((a, b) => order.indexOf(a.outcome) - order.indexOf(b.outcome) || isWorse(a.cases[0], b.cases[0]));
}

function groupTitle(group) {
  const n = count(group.cases.length, "frame");
  if (group.outcome === "incomparable") return [`${n} not compared`, group.cause];
  if (group.outcome === "tolerated") return [`${n} tolerated`, "within the rule, not the same to the bit"];
  if (group.cause) return [`${n} different`, `first target that differs: ${group.cause}`];
  return [`${n} different`, data.knows_targets ? "which target differs first is not known here" : ""];
}

const pictured = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (!entry.isIntersecting) continue;
    pictured.unobserve(entry.target);
    entry.target.style.backgroundImage = `url(${urlOf(entry.target.dataset.picture)})`;
  }
});

function listButton(entry) {
  const numbers = entry.outcome === "incomparable" ? entry.why
    : `${percent(entry.differing / entry.total)} by up to ${entry.worst[0][2]} \u00b7 FLIP ${entry.flip === null ? "none" : entry.flip.toPrecision(2)}`;
  const text = element("span", {}, element("span", { className: "name", textContent: breakable(entry.name) }),
    element("span", { className: "numbers", textContent: numbers }));
  const shown = entry.frame ?? entry.reference;
  const button = element("button", { className: shown ? "" : "bare" });
  if (shown) {
    const picture = element("span", { className: "picture" });
    picture.dataset.picture = shown.color;
    pictured.observe(picture);
    button.append(picture);
  }
  button.append(text);
  button.dataset.case = entry.id;
  button.dataset.search = `${entry.name} ${entry.first} ${words[entry.outcome]}`.toLowerCase();
  button.addEventListener("click", () => open(entry.id));
  return button;
}

let shownOrder = [];  // the ids of the cases in the list, from above
let shownGroups = []; // as groups() says
const groupOf = (entry) => shownGroups.find((group) => group.cases.includes(entry));

function fillList() {
  const list = find("#list");
  shownGroups = groups();
  for (const group of shownGroups) {
    const [title, cause] = groupTitle(group);
    const summary = element("summary", {}, element("b", { className: group.outcome, textContent: title }));
    if (cause) summary.append(element("small", { textContent: cause }));
    list.append(element("details", { open: true }, summary, ...group.cases.map(listButton)));
    shownOrder.push(...group.cases.map((entry) => entry.id));
  }
  for (const problem of data.problems)
    list.prepend(element("p", { className: "incomparable", textContent: problem }));
  if (data.same.length > 0) {
    const same = element("details", {}, element("summary", {}, element("b", { className: "same",
      textContent: `${count(data.same.length, "frame")} the same` })));
    for (const name of data.same) same.append(element("div", { textContent: name, className: "numbers" }));
    list.append(same);
  }
}

function applyFilter() {
  const wanted = find("#filter").value.trim().toLowerCase();
  for (const button of document.querySelectorAll("#list button")) button.hidden = !button.dataset.search.includes(wanted);
  for (const group of document.querySelectorAll("#list details"))
    if (group.querySelector("button")) group.hidden = !group.querySelector("button:not([hidden])");
}

const visibleOrder = () => shownOrder.filter((id) => !find(`#list button[data-case="${id}"]`).hidden);

const viewer = new Viewer(find("#stage"), () => showReadout());
let current = null; // what is shown: a case, and its frames
let opening = 0;    // only the last that was asked for is shown

async function open(id) {
  const entry = data.cases[id];
  const mine = ++opening;
  for (const button of document.querySelectorAll("#list button")) {
    const isThis = Number(button.dataset.case) === id;
    if (isThis) button.setAttribute("aria-current", "true"); else button.removeAttribute("aria-current");
    if (isThis) button.scrollIntoView({ block: "nearest" });
  }
  const [frame, reference] = await Promise.all([entry.frame, entry.reference].map((one) => one ? Frame.load(one) : null));
  const flip = entry.flip_map ? await flipMapOf(entry.flip_map) : null;
  if (mine !== opening) return;
  const isComparable = frame && reference && entry.outcome !== "incomparable";
  current = { entry, frame, reference, isComparable, worst: 0 };
  find("#case").hidden = false;
  find("#stage").hidden = !frame && !reference;
  find("#tools").hidden = find("#under").hidden = find("#stage").hidden;
  showFacts(entry);
  showAccept();
  showExposure();
  if (frame || reference)
    viewer.show(frame, reference, isComparable ? differenceCanvas(frame, reference) : null, flip);
  showModes();
  history.replaceState(null, "", `#${encodeURIComponent(entry.name)}&${viewer.mode}`);
  document.body.dataset.shown = entry.name;
}

function showModes() {
  find("#modes").replaceChildren(...modes.map((mode, i) => {
    const button = element("button", { textContent: mode.label, title: `key ${i + 1}`, disabled: !viewer.any || !viewer.allows(mode.name) });
    button.setAttribute("aria-pressed", viewer.mode === mode.name);
    button.addEventListener("click", () => changeMode(mode.name));
    return button;
  }));
  showLegend();
}

function changeMode(mode) {
  viewer.setMode(mode);
  history.replaceState(null, "", `#${encodeURIComponent(current.entry.name)}&${viewer.mode}`);
  showModes();
}

function showExposure() {
  const box = find("#exposure");
  box.hidden = !current.frame?.isLight && !current.reference?.isLight;
  const range = box.querySelector("input");
  range.value = 0;
  box.querySelector("output").textContent = "0 EV";
}

function changeExposure() {
  const ev = Number(find("#exposure input").value);
  find("#exposure output").textContent = `${ev} EV`;
  for (const frame of [current.frame, current.reference]) frame?.expose(ev);
  viewer.draw();
}

function showLegend() {
  const legend = find("#legend");
  const isFlip = viewer.mode === "flip";
  legend.hidden = !current?.isComparable || !["side", "difference", "flip"].includes(viewer.mode);
  const ticks = isFlip ? [0, 0.2, 0.4, 0.6, 0.8, 1].map((v) => [v, v])
    : [1, 2, 4, 8, 16, 32, 64, 128, 255].map((codes) => [differencePlace(codes), codes]);
  const ramp = element("div", { className: "ramp" });
  ramp.style.background = rampStyle(isFlip ? flipRamp : differenceRamp);
  legend.replaceChildren(
    element("span", { textContent: isFlip ? "FLIP, what a person sees alternating the two"
      : "difference in codes of 255, the worst channel; black: none" }),
    ramp, element("div", { className: "ticks" }, ...ticks.map(([place, text]) => {
      const tick = element("span", { textContent: text });
      tick.style.left = `${100 * place}%`;
      return tick;
    })));
}

// The pixel under the mouse, else the marked one, in both frames.
function showReadout() {
  find("#scale").textContent = viewer.scale >= 1 ? `${viewer.scale}\u00d7` : `${Math.round(100 * viewer.scale)} %`;
  const pixel = viewer.hovered ?? (viewer.isMarked ? viewer.marked : null);
  const readout = find("#readout");
  if (!pixel || !current) {
    readout.textContent = "point at a pixel, or press an arrow key, for its values";
    return;
  }
  const { frame, reference } = current;
  const at = `(${pixel.x},${pixel.y})`.padEnd(12);
  const lines = [];
  for (const [name, one] of [["new", frame], ["reference", reference]]) {
    if (!one?.holds(pixel.x, pixel.y)) continue;
    const swatch = element("span", { className: "swatch" });
    swatch.style.background = one.colorAt(pixel.x, pixel.y);
    lines.push(`${lines.length ? "\n" + " ".repeat(12) : at}${name.padEnd(10)}`, swatch, ` ${one.text(pixel.x, pixel.y)}`);
  }
  if (current.isComparable) {
    const flip = viewer.flip ? `   FLIP ${viewer.flip.at(pixel.x, pixel.y).toFixed(2)}` : "";
    lines.push(`   differs by ${count(codesBetween(frame, reference, pixel.x, pixel.y), "code")}${flip}`);
  }
  readout.replaceChildren(...lines);
}

function showFacts(entry) {
  find("h2").textContent = entry.name;
  const verdict = find("#verdict");
  verdict.className = entry.outcome;
  verdict.textContent = entry.worst.length === 0 ? `${words[entry.outcome]}: ${entry.why}`
    : `${words[entry.outcome]}: ${entry.differing} of ${count(entry.total, "pixel")} (${percent(entry.differing / entry.total)}), ` +
      `the worst by ${count(entry.worst[0][2], "code")} \u00b7 RMSE ${entry.rmse.toPrecision(2)} \u00b7 ` +
      `PSNR ${entry.psnr.toFixed(1)} dB \u00b7 FLIP ${entry.flip === null ? "none" : entry.flip.toPrecision(2)}`;
  for (const id of ["render_line", "bless_line"]) {
    const button = element("button", { textContent: "copy" });
    button.addEventListener("click", () => navigator.clipboard.writeText(entry[id]));
    find(`#${id}`).replaceChildren(button, entry[id]);
    find(`#${id}`).hidden = !entry[id];
    find(`#${id}`).previousElementSibling.hidden = !entry[id];
  }
  find("#targets_box").hidden = entry.targets.length === 0;
  find("#targets").replaceChildren(...entry.targets.map(([name, differs]) => element("span", {
    textContent: `${name} ${differs ? "\u2260" : "="}`,
    className: name === entry.first ? "differs first" : differs ? "differs" : "" })));
  find("#worst").replaceChildren(...entry.worst.map(([x, y, codes]) => {
    const button = element("button", { textContent: `(${x},${y})` });
    button.addEventListener("click", () => viewer.goTo(x, y));
    return element("li", {}, button, ` by ${codes}`);
  }));
  find("#worst").parentElement.hidden = find("#histogram").parentElement.hidden = entry.worst.length === 0;
  if (entry.worst.length > 0) drawHistogram(entry);
  const facts = [["rule", entry.rule], ["settings", entry.settings], ["hash", entry.hash],
    ["reference drawn by", entry.reference_renderer], ["drawn now by", entry.renderer],
    ["RMSE, PSNR", entry.rmse === null ? "" : `${entry.rmse.toPrecision(3)} of display values, ${entry.psnr.toFixed(1)} dB`],
    ["new", entry.frame_file], ["reference", entry.reference_file]];
  find("#about").replaceChildren(...facts.filter(([, text]) => text).flatMap(([name, text]) =>
    [element("dt", { textContent: name }), element("dd", { textContent: text })]));
}

// Both axes by their logarithms: one pixel and half the frame, one code and 255, can all be seen.
function drawHistogram(entry) {
  const canvas = find("#histogram");
  const context = canvas.getContext("2d");
  const [left, bottom, width, height] = [46, 146, 404, 136];
  const x = (codes) => left + 5 + (width - 10) * differencePlace(codes);
  const most = Math.log10(Math.max(entry.total, 10));
  const y = (pixels) => bottom - height * (0.04 + 0.96 * Math.log10(pixels) / most);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = "#a3a3aa";
  context.textAlign = "right";
  for (let power = 0; power <= most; ++power) {
    context.fillStyle = "#3d3d41";
    context.fillRect(left, Math.round(y(10 ** power)), width, 1);
    context.fillStyle = "#a3a3aa";
    context.fillText((10 ** power).toLocaleString("en"), left - 5, y(10 ** power) + 4);
  }
  context.textAlign = "center";
  for (const codes of [1, 2, 4, 8, 16, 32, 64, 128, 255]) context.fillText(codes, x(codes), bottom + 15);
  for (const [codes, pixels] of entry.histogram) {
    context.fillStyle = `rgb(${differenceRamp(differencePlace(codes)).join(" ")})`;
    const [from, to] = [x(Math.max(codes - 0.45, 0.96)), x(codes + 0.45)];
    context.fillRect(from - 1, y(pixels), Math.max(to - from, 2), bottom - y(pixels));
  }
  context.fillStyle = "#e8e8ea";
  for (const codes of entry.rule_codes) context.fillRect(Math.round(x(codes + 0.5)), bottom - height, 1, height);
  find("#histogram_text").textContent = entry.rule_codes.length === 0 ? ""
    : `The lines: by more than ${entry.rule_codes[0]} codes only ${count(entry.rule_pixels[1], "pixel")} may differ, by more than ` +
      `${entry.rule_codes[1]} none, and at all ${entry.rule_pixels[0]}.`;
}

function step(by) {
  const order = visibleOrder();
  const at = order.indexOf(current?.entry.id);
  const next = order[Math.min(Math.max(at + by, 0), order.length - 1)];
  if (next !== undefined) open(next);
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || find("#help").open) return;
  if (event.target.matches("input[type=search], input[type=text]")) {
    if (event.key === "Escape") event.target.blur();
    return;
  }
  const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  const isRange = event.target.matches("input[type=range]");
  if (move && current && !isRange) {
    const by = event.shiftKey ? 10 : 1;
    viewer.mark(viewer.marked.x + by * move[0], viewer.marked.y + by * move[1], true);
  } else if (event.key === "j") step(1);
  else if (event.key === "k") step(-1);
  else if (event.key === "/") find("#filter").focus();
  else if (event.key === "?") find("#help").showModal();
  else if (event.key === "a" && current && !find("#accept").hidden) find("#because").focus();
  else if (!current || find("#stage").hidden) return;
  else if (event.key === "+" || event.key === "=" || event.key === "-") {
    // About the marked pixel, where there is one.
    if (viewer.isMarked) viewer.center = { x: viewer.marked.x + 0.5, y: viewer.marked.y + 0.5 };
    viewer.zoom(event.key === "-" ? -1 : 1);
  } else if (event.key === "0") viewer.fit();
  else if (event.key === "[") viewer.moveDivider(-0.05);
  else if (event.key === "]") viewer.moveDivider(0.05);
  else if (event.key === " " && viewer.mode === "blink") viewer.turn();
  else if (event.key === "w" && current.entry.worst.length > 0) {
    const [x, y] = current.entry.worst[current.worst++ % current.entry.worst.length];
    viewer.goTo(x, y);
  } else if (/^[1-5]$/.test(event.key)) changeMode(modes[event.key - 1].name);
  else return;
  event.preventDefault();
}

function begin() {
  document.title = find("h1").textContent = data.title;
  for (const outcome of ["different", "incomparable", "tolerated", "same"])
    find("#counts").append(element("span", { className: data.counts[outcome] ? outcome : "none" },
      element("b", { textContent: data.counts[outcome] }), words[outcome]));
  find("#drawn_by").textContent = data.drawn_by;
  fillList();
  for (const row of document.querySelectorAll(".review")) row.hidden = !data.for_review;
  if (data.for_review) beginReview();
  document.addEventListener("keydown", onKey);
  find("#filter").addEventListener("input", applyFilter);
  find("#exposure input").addEventListener("input", changeExposure);
  find("#help_button").addEventListener("click", () => find("#help").showModal());
  for (const button of document.querySelectorAll("[data-zoom]"))
    button.addEventListener("click", () => button.dataset.zoom === "fit" ? viewer.fit() : viewer.zoom(button.dataset.zoom === "in" ? 1 : -1));
  const [name, mode] = location.hash.slice(1).split("&");
  const wanted = data.cases.find((entry) => entry.name === decodeURIComponent(name));
  if (mode) viewer.mode = mode;
  if (wanted || shownOrder.length > 0) open(wanted?.id ?? shownOrder[0]);
  else {
    find("#nothing").hidden = false;
    find("#nothing").textContent = data.same.length > 0 ? "Every frame is the same as its reference." : "No frame was compared.";
  }
}
begin();
