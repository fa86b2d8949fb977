"use strict";
(() => {
  const root = document.documentElement;
  const read = (id) => JSON.parse(document.getElementById(id).textContent);
  const figures = read("figures"), theme = read("figure-theme");
  const charts = [...document.querySelectorAll(".chart")];

  // ---- light and dark: the reader's choice, else the system's; on paper always light
  const system = matchMedia("(prefers-color-scheme: dark)");
  let choice = null;
  const wanted = () => choice || (system.matches ? "dark" : "light");

  // colours of figures are CSS variables: "var(--right)" becomes what the style sheet says now
  function coloured(value, style) {
    if (typeof value === "string") return value.startsWith("var(--") ? style.getPropertyValue(value.slice(4, -1)).trim() : value;
    if (Array.isArray(value)) return value.map((item) => coloured(item, style));
    if (value === null || typeof value !== "object") return value;
    return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, coloured(item, style)]));
  }

  function draw(chart, width, height) {
    const style = getComputedStyle(root), figure = figures[chart.dataset.figure];
    const layout = { ...figure.layout, template: theme, ...(width ? { width, height } : { autosize: true }) };
    layout.font = { family: getComputedStyle(document.body).fontFamily, size: width ? 10 : 13 };
    return Plotly.react(chart, coloured(figure.data, style), coloured(layout, style), settings(chart, width));
  }

  const settings = (chart, width) => ({
    responsive: !width, displaylogo: false, displayModeBar: chart.classList.contains("gl"),
    modeBarButtons: [["toImage", "resetCameraDefault3d"]],
  });

  function paint(name) {
    root.dataset.theme = name;
    for (const chart of charts) if (chart.dataset.drawn) draw(chart);
  }

  const switcher = document.getElementById("theme");
  switcher.hidden = false;
  switcher.addEventListener("click", () => { choice = wanted() === "dark" ? "light" : "dark"; paint(choice); });
  system.addEventListener("change", () => paint(wanted()));
  root.dataset.theme = wanted();

  addEventListener("beforeprint", () => {
    root.dataset.theme = "light";
    for (const chart of charts) {
      const half = chart.closest(".pair") !== null;
      if (chart.dataset.drawn && !chart.classList.contains("gl")) draw(chart, half ? 310 : 650, half ? 300 : 380);
    }
  });
  addEventListener("afterprint", () => paint(wanted()));

  // ---- the 3-D views: shown where the browser has WebGL, beside the still drawing that is always there
  function webgl() {
    try {
      return Boolean(document.createElement("canvas").getContext("webgl"));
    } catch {
      return false;
    }
  }
  const solid = webgl();
  for (const view of document.querySelectorAll(".views")) {
    const chart = view.parentElement.querySelector(".chart.gl"), still = view.parentElement.querySelector(".still");
    const buttons = [...view.querySelectorAll("button")];
    const show = (name) => {
      chart.hidden = name !== "3d";
      still.toggleAttribute("hidden", name === "3d");
      for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.view === name));
      if (name !== "3d") return;
      if (chart.dataset.drawn) Plotly.Plots.resize(chart);
      else Promise.resolve().then(() => draw(chart)).then(() => { chart.dataset.drawn = "yes"; }, () => show("still"));
    };
    if (!solid) { view.parentElement.querySelector(".no-webgl").hidden = false; continue; }
    view.hidden = false;
    for (const button of buttons) button.addEventListener("click", () => show(button.dataset.view));
    show("3d");
  }

  // ---- the other figures, one after another, so that the page can be read meanwhile
  (async () => {
    for (const chart of charts) {
      if (chart.classList.contains("gl")) continue;
      await draw(chart);
      chart.dataset.drawn = "yes";
      await new Promise((next) => setTimeout(next));
    }
    root.dataset.ready = "yes";
  })();

  // ---- the atlas: sort by any column, filter by class, orbit and joints
  const table = document.getElementById("atlas"), body = table.tBodies[0], rows = [...body.rows];
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => head.querySelector("button").addEventListener("click", () => {
    const numeric = head.classList.contains("n");
    const up = head.getAttribute("aria-sort") ? head.getAttribute("aria-sort") === "descending" : !numeric;
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
    const key = (row) => row.cells[column].dataset.value ?? row.cells[column].textContent;
    const sign = up ? 1 : -1;
    rows.sort((a, b) => sign * (numeric ? key(a) - key(b) : key(a).localeCompare(key(b), "en", { numeric: true })));
    body.append(...rows);
  }));

  const kind = document.getElementById("kind"), single = document.getElementById("single"), shown = document.getElementById("shown");
  const chips = [...document.querySelectorAll("#joints button")];
  function filter() {
    let count = 0;
    for (const row of rows) {
      const joints = row.dataset.joints.split(" ");
      const fits = chips.every((chip) => chip.dataset.state === "any" || joints.includes(chip.value) === (chip.dataset.state === "on"));
      row.hidden = !(fits && (!kind.value || row.dataset.class === kind.value) && (!single.checked || row.dataset.orbit === "first"));
      count += row.hidden ? 0 : 1;
    }
    shown.textContent = `${count} of ${rows.length} schemes`;
  }
  const states = ["any", "on", "off"], words = { any: "either", on: "actuated", off: "passive" };
  for (const chip of chips) chip.addEventListener("click", () => {
    chip.dataset.state = states[(states.indexOf(chip.dataset.state) + 1) % 3];
    chip.setAttribute("aria-label", `joint ${chip.value}: ${words[chip.dataset.state]}`);
    filter();
  });
  kind.addEventListener("change", filter);
  single.addEventListener("change", filter);
  document.getElementById("reset").addEventListener("click", () => {
    kind.value = "";
    single.checked = false;
    for (const chip of chips) { chip.dataset.state = "any"; chip.setAttribute("aria-label", `joint ${chip.value}: either`); }
    filter();
  });
  document.getElementById("tools").hidden = false;
  filter();
})();
