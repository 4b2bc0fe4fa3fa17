"use strict";
// Pictures that can be zoomed into: a button under each takes the curves of its table to uPlot, and back.
(() => {
  const read = (link) => {
    const text = new TextDecoder().decode(Uint8Array.from(atob(link.href.split(",")[1]), (c) => c.charCodeAt(0)));
    const rows = text.trim().split("\n").slice(1).map((r) => r.split(","));
    return (k) => { const v = rows.map((r) => (r[k] === "" || r[k] === undefined ? null : Number(r[k]))); return v; };
  };
  const colour = (name) => {
    const variable = /^var\((.*)\)$/.exec(name);
    return variable ? getComputedStyle(document.documentElement).getPropertyValue(variable[1]).trim() : name;
  };
  // Fingers: what is under one or two stays under them; up and down they scroll the page.
  const fingers = (u, log, all) => {
    const to = (v) => (log ? Math.log10(v) : v), back = (t) => (log ? 10 ** t : t);
    let held = [];
    const places = (event) => Array.from(event.touches, (t) => t.clientX - u.over.getBoundingClientRect().left).slice(0, 2).sort((a, b) => a - b);
    const hold = (event) => { held = places(event).map((p) => to(u.posToVal(p, "x"))); };
    const move = (event) => {
      const at = places(event), [low, high] = [to(u.scales.x.min), to(u.scales.x.max)], width = u.over.clientWidth;
      if (!at.length || at.length !== held.length) { hold(event); return; }
      const slope = at.length > 1 ? (held[1] - held[0]) / Math.max(at[1] - at[0], 1) : (high - low) / width;
      if (!(slope > 0)) return;
      if (event.cancelable) event.preventDefault();
      const min = held[0] - slope * at[0], range = { min: back(min), max: back(min + slope * width) };
      all().forEach((c) => c.setScale("x", range));
    };
    u.over.style.touchAction = "pan-y";
    u.over.addEventListener("touchstart", hold, { passive: true });
    u.over.addEventListener("touchend", hold, { passive: true });
    u.over.addEventListener("touchmove", move, { passive: false });
  };
  const chart = (panel, column, key, width, all) => {
    const x = column(panel.x), rows = x.map((v, i) => i).filter((i) => x[i] !== null && (!panel.xlog || x[i] > 0));
    const pick = (k, log) => { const v = column(k); return rows.map((i) => (log && !(v[i] > 0) ? null : v[i])); };
    const axis = (label) => ({ label, stroke: colour("var(--ink)"), grid: { stroke: colour("var(--line)"), width: 0.5 }, ticks: { stroke: colour("var(--line)") },
      values: (u, splits) => splits.map((v) => (v === null ? "" : String(Number(v.toPrecision(6))))) });
    return {
      data: [pick(panel.x, panel.xlog), ...panel.series.map((s) => pick(s.column, panel.ylog))],
      options: {
        width, height: 260, hooks: { ready: [(u) => fingers(u, panel.xlog, all)] }, cursor: { sync: { key, scales: ["x", null] }, drag: { x: true, y: false } },
        scales: { x: { time: false, distr: panel.xlog ? 3 : 1 }, y: { distr: panel.ylog ? 3 : 1 } },
        axes: [axis(panel.xlabel), { ...axis(panel.ylabel), size: 64 }],
        series: [{ label: panel.xlabel, value: (u, v) => (v === null ? "–" : v.toPrecision(5)) },
          ...panel.series.map((s) => ({ label: s.label, stroke: colour(s.colour), width: 1.5, dash: s.dashed ? [6, 4] : undefined, points: { show: false },
            value: (u, v) => (v === null || v === undefined ? "–" : v.toPrecision(4)) }))],
      },
    };
  };
  document.querySelectorAll("figure[data-panels]").forEach((figure, number) => {
    const still = figure.querySelector("svg"), tools = figure.querySelector(".tools"), live = document.createElement("div");
    const button = document.createElement("button");
    let charts = [];
    button.type = "button"; button.textContent = "Zoom"; live.className = "live"; live.hidden = true;
    tools.prepend(button); still.after(live);
    const show = () => {
      charts.forEach((c) => c.destroy());
      const column = read(tools.querySelector("a")), width = live.clientWidth || 320;
      charts = JSON.parse(figure.dataset.panels).map((panel) => {
        const { options, data } = chart(panel, column, `figure${number}`, width, () => charts);
        return new uPlot(options, data, live);
      });
    };
    button.addEventListener("click", () => {
      live.hidden = !live.hidden; figure.classList.toggle("zoomed", !live.hidden);
      button.textContent = live.hidden ? "Zoom" : "Back to the picture";
      tools.querySelector(".hint").hidden = live.hidden;
      if (!live.hidden) show();
    });
    window.addEventListener("resize", () => { const width = live.clientWidth; if (width) charts.forEach((c) => c.setSize({ width, height: 260 })); });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!live.hidden) show(); });
  });
})();
