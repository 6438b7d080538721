// Accepting frames, where frame_check --review serves the page: a reason, and a button for this frame or its group.
"use strict";

const accepted = new Map(); // what became of a case, by its id

function canAccept(entry) { return data.for_review && entry.frame !== null && !accepted.has(entry.id); }

function showAccepted() {
  for (const id of accepted.keys()) find(`#list button[data-case="${id}"]`).classList.add("accepted");
  const total = find("#counts .accepted");
  total.hidden = accepted.size === 0;
  total.querySelector("b").textContent = accepted.size;
  if (current) showAccept();
}

function showAccept() {
  const { entry } = current;
  const group = groupOf(entry).cases.filter(canAccept);
  find("#accept").hidden = !data.for_review || (!canAccept(entry) && !accepted.has(entry.id));
  find("#accept_one").hidden = find("#because").hidden = !canAccept(entry);
  const rest = find("#accept_group");
  rest.hidden = !canAccept(entry) || group.length < 2;
  rest.textContent = `Accept all ${group.length} of its group`;
  const end = data.cases.some(canAccept) ? "" : "; nothing is left to accept, Ctrl-C in the terminal ends the review";
  find("#accept_said").textContent = accepted.has(entry.id) ? `accepted: ${accepted.get(entry.id)}${end}` : "";
}

// One after the other: each is drawn once more before it is written.
async function acceptAll(entries) {
  const because = find("#because");
  if (!because.reportValidity()) return;
  find("#accept").inert = true;
  let refused = "";
  for (const [i, entry] of entries.entries()) {
    find("#accept_said").textContent = `drawing it again${entries.length > 1 ? `, ${i + 1} of ${entries.length}` : ""} \u2026`;
    try {
      const answer = await fetch("accept", { method: "POST", headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ case: entry.name, because: because.value }) });
      const said = await answer.json();
      if (answer.ok) accepted.set(entry.id, said.became);
      else refused = `${entry.name}: ${said.error}`;
    } catch {
      refused = "frame_check has ended; start the review again";
      break;
    }
  }
  find("#accept").inert = false;
  showAccepted();
  if (refused) {
    find("#accept_said").textContent = `not accepted: ${refused}`;
    return;
  }
  because.blur();
  const order = visibleOrder();
  const next = order.slice(order.indexOf(current.entry.id)).concat(order).find((id) => canAccept(data.cases[id]));
  if (next !== undefined) open(next);
}

async function beginReview() {
  find("#accept").addEventListener("submit", (event) => {
    event.preventDefault();
    acceptAll([current.entry]);
  });
  find("#accept_group").addEventListener("click", () => acceptAll(groupOf(current.entry).cases.filter(canAccept)));
  find("#counts").append(element("span", { className: "accepted same", hidden: true }, element("b"), "accepted"));
  const before = await (await fetch("accepted")).json(); // the page may be loaded again
  for (const entry of data.cases) if (before[entry.name] !== undefined) accepted.set(entry.id, before[entry.name]);
  showAccepted();
}
