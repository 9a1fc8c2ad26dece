"use strict";
// Axes, lines and marks in SVG, with zoom and hover. Nothing here knows what is drawn.

const SVG = "http://www.w3.org/2000/svg";

function element(name, attributes, parent, text) {
  const made = document.createElementNS(SVG, name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  if (parent) parent.appendChild(made);
  return made;
}

function part(tag, parent, text, className) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  if (parent) parent.appendChild(made);
  return made;
}

// 0.00012 as 1.2·10⁻⁴, 5 significant digits.
function told(value, digits = 5) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(+value.toPrecision(digits)).replace("-", "−");
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const raised = String(+power).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  return (+mantissa === 1 ? "" : String(+mantissa).replace("-", "−") + "·") + "10" + raised;
}

function ticksOf([low, high], log, count) {
  const ticks = [];
  if (log) {
    const decades = Math.log10(high / low);
    if (decades > 0.7) {
      const steps = decades < 2.8 ? [1, 2, 5] : [1];
      const every = Math.max(1, Math.ceil(decades / count));
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += every)
        for (const step of steps) ticks.push(step * 10 ** power);
      return ticks.filter((tick) => tick >= low && tick <= high);
    }
  }
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
  for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push(+(i * step).toPrecision(12));
  return ticks;
}

class Axis {
  constructor(domain, log, from, to) {
    this.domain = domain; this.log = log; this.from = from; this.to = to;
  }
  at(value) {
    if (value === null || (this.log && !(value > 0))) return NaN;
    const f = this.log ? Math.log : (v) => v;
    const [low, high] = this.domain.map(f);
    return this.from + (this.to - this.from) * (f(value) - low) / (high - low);
  }
  back(pixel) {
    const share = (pixel - this.from) / (this.to - this.from), [low, high] = this.domain;
    return this.log ? low * (high / low) ** share : low + share * (high - low);
  }
}

// decades: the most that a logarithmic axis shows, below its highest value.
function rangeOf(values, log, pad, decades = Infinity) {
  const good = values.filter((v) => v !== null && isFinite(v) && (!log || v > 0));
  if (!good.length) return log ? [1, 10] : [0, 1];
  let low = good.reduce((a, b) => Math.min(a, b)), high = good.reduce((a, b) => Math.max(a, b));
  if (log) low = Math.max(low, high / 10 ** decades);
  if (low === high) return log ? [low / 2, low * 2] : [low - 1, low + 1];
  if (log) { const more = (high / low) ** pad; return [low / more, high * more]; }
  return [low - pad * (high - low), high + pad * (high - low)];
}

// A chart of series { label, colour, width, x, y, kind (per point: 1 solid, 0 dashed, -1 dotted), mark, name (at its end), tip(i), lines, bar,
// between (per interval: two control points of a cubic, null for a gap; without it lines) }.
class Chart {
  constructor(host, names) {
    this.host = host; this.names = names; this.series = []; this.zoom = null; this.hidden = new Set();
    this.svg = element("svg", { role: "img" }, host);
    this.tip = part("div", host, undefined, "tip");
    this.tip.hidden = true;
    this.listen();
    new ResizeObserver(() => this.draw()).observe(host);
    window.addEventListener("beforeprint", () => this.draw(Math.min(host.clientWidth, host.closest(".charts") ? 345 : 718)));  // of A4
    window.addEventListener("afterprint", () => this.draw());
  }

  show(series, names) { this.series = series; Object.assign(this.names, names); this.zoom = null; this.draw(); }

  seen() { return this.series.filter((s) => !this.hidden.has(s.label)); }

  axes(width) {
    const height = Math.round(Math.max(260, Math.min(440, 0.55 * width)));
    this.size = { width, height, left: 62, right: 12, top: 10, bottom: 44 };
    const all = this.seen();
    const x = this.zoom ? this.zoom[0] : rangeOf(all.flatMap((s) => s.x), this.names.xLog, this.names.xPad ?? 0.01);
    const y = this.zoom ? this.zoom[1] : rangeOf(all.flatMap((s) => s.y), this.names.yLog, 0.08, this.names.decades);
    this.x = new Axis(x, this.names.xLog, this.size.left, width - this.size.right);
    this.y = new Axis(y, this.names.yLog, height - this.size.bottom, this.size.top);
  }

  draw(wide = this.host.clientWidth || 700) {
    this.axes(wide);
    const { width, height } = this.size;
    this.svg.replaceChildren();
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.setAttribute("aria-label", `${this.names.y} over ${this.names.x}`);
    this.drawGrid();
    const id = `clip${Chart.count = (Chart.count || 0) + 1}`;
    const clip = element("clipPath", { id }, this.svg);
    element("rect", { x: this.x.from, y: this.y.to, width: this.x.to - this.x.from, height: this.y.from - this.y.to }, clip);
    const layer = element("g", { "clip-path": `url(#${id})` }, this.svg);
    for (const s of this.seen()) this.drawSeries(s, layer);
    this.frame = element("rect", { fill: "#0001", stroke: "#5b6570", visibility: "hidden" }, this.svg);
    this.spot = element("circle", { r: 4, fill: "none", stroke: "#c1121f", "stroke-width": 2, visibility: "hidden" }, this.svg);
  }

  drawGrid() {
    const { width, height, left, right, bottom } = this.size;
    for (const tick of ticksOf(this.x.domain, this.names.xLog, width / 90)) {
      const x = this.x.at(tick);
      element("line", { x1: x, x2: x, y1: this.y.to, y2: this.y.from, stroke: "#eceff2" }, this.svg);
      element("text", { x, y: height - bottom + 16, "text-anchor": "middle" }, this.svg, told(tick));
    }
    for (const tick of ticksOf(this.y.domain, this.names.yLog, height / 60)) {
      const y = this.y.at(tick);
      element("line", { x1: left, x2: width - right, y1: y, y2: y, stroke: "#eceff2" }, this.svg);
      element("text", { x: left - 6, y: y + 4, "text-anchor": "end" }, this.svg, told(tick));
    }
    element("text", { x: (this.x.from + this.x.to) / 2, y: height - 6, "text-anchor": "middle" }, this.svg, this.names.x);
    const middle = (this.y.from + this.y.to) / 2;
    element("text", { x: 13, y: middle, "text-anchor": "middle", transform: `rotate(-90 13 ${middle})` }, this.svg, this.names.y);
  }

  // Runs of intervals of one kind; a fold belongs to both of its neighbours.
  runs(s) {
    const runs = [];
    for (let i = 0; i + 1 < s.x.length; ++i) {
      const flags = [i, i + 1].filter((k) => s.mark[k] !== "fold").map((k) => s.kind[k]);
      const kind = flags.length ? Math.min(...flags.map((f) => (f === 0 ? -2 : f))) : -2;
      const last = runs[runs.length - 1];
      if (last && last.kind === kind) last.to = i + 1; else runs.push({ kind, from: i, to: i + 1 });
    }
    return runs;
  }

  pathOf(s, from, to) {
    let path = "", pen = "M";
    for (let i = from; i <= to; ++i) {
      const x = this.x.at(s.x[i]), y = this.y.at(s.y[i]);
      const way = s.between && i > from ? s.between[i - 1] : undefined;
      if (!isFinite(x) || !isFinite(y) || way === null) pen = "M";
      if (!isFinite(x) || !isFinite(y)) continue;
      if (way && pen !== "M") path += `C${[0, 2].map((k) => `${this.x.at(way[k]).toFixed(2)} ${this.y.at(way[k + 1]).toFixed(2)}`).join(" ")} `;
      path += `${way && pen !== "M" ? "" : pen}${x.toFixed(2)} ${y.toFixed(2)}`; pen = "L";
    }
    return path;
  }

  drawSeries(s, layer) {
    const style = { "1": {}, "-2": { "stroke-dasharray": "6 4" }, "-1": { "stroke-dasharray": "1.5 3.5", opacity: 0.75 } };
    if (s.lines !== false) for (const { kind, from, to } of this.runs(s)) {
      element("path", { d: this.pathOf(s, from, to), fill: "none", stroke: s.colour, "stroke-width": s.width || 1.8,
        "stroke-linejoin": "round", "stroke-linecap": kind === -1 ? "round" : "butt", ...style[kind] }, layer);
    }
    if (s.bar) this.drawBar(s, layer);
    if (s.name) element("text", { x: this.x.to - 4, y: this.y.at(s.y[0]) + (s.below ? 14 : -5), "text-anchor": "end" }, layer, s.name);
    s.x.forEach((value, i) => this.drawMark(s, i, layer));
  }

  drawMark(s, i, layer) {
    const x = this.x.at(s.x[i]), y = this.y.at(s.y[i]), mark = s.mark[i];
    if (!mark || !isFinite(x) || !isFinite(y)) return;
    const shape = { stroke: mark === "fold" ? s.colour : "#fff", fill: mark === "fold" ? "#fff" : s.colour, "stroke-width": 1 };
    if (mark === "peak") element("circle", { cx: x, cy: y, r: 4, ...shape }, layer);
    if (mark === "dot") element("circle", { cx: x, cy: y, r: 5, ...shape }, layer);
    if (mark === "fold") element("path", { d: `M${x} ${y - 4}l4 4l-4 4l-4 -4z`, ...shape }, layer);
    if (mark === "richer") element("text", { x, y: y + 5, "text-anchor": "middle", style: `font-size:15px;fill:${s.colour}` }, layer, "☆");
    if (mark === "best") element("text", { x, y: y + 7, "text-anchor": "middle", style: "font-size:22px;fill:#c1121f" }, layer, "★");
    if (mark === "end") element("path", { d: `M${x - 4} ${y - 4}l8 8m0 -8l-8 8`, stroke: "#c1121f", "stroke-width": 2 }, layer);
  }

  drawBar(s, layer) {
    const { frequency: f, amplitude: a, of_frequency: df, of_amplitude: da } = s.bar;
    const x = this.x.at(f), y = this.y.at(a), line = { stroke: s.colour, "stroke-width": 1, opacity: 0.7 };
    element("line", { x1: x, x2: x, y1: this.y.at(a * Math.max(0.1, 1 - da)), y2: this.y.at(a * (1 + da)), ...line }, layer);
    element("line", { y1: y, y2: y, x1: this.x.at(f * (1 - df)), x2: this.x.at(f * (1 + df)), ...line }, layer);
  }

  place(event) {
    const box = this.svg.getBoundingClientRect(), scale = this.size.width / box.width;
    const inside = (v, a) => Math.max(Math.min(a.from, a.to), Math.min(Math.max(a.from, a.to), v));
    return [inside((event.clientX - box.left) * scale, this.x), inside((event.clientY - box.top) * scale, this.y)];
  }

  listen() {
    let start = null;
    this.svg.addEventListener("pointerdown", (e) => { start = this.place(e); this.svg.setPointerCapture(e.pointerId); });
    this.svg.addEventListener("pointermove", (e) => (start ? this.drag(start, this.place(e)) : this.hover(this.place(e))));
    this.svg.addEventListener("pointerup", (e) => { if (start) this.zoomTo(start, this.place(e)); start = null; });
    this.svg.addEventListener("pointercancel", () => { start = null; this.draw(); });
    this.svg.addEventListener("pointerleave", () => this.point(null));
    this.svg.addEventListener("dblclick", () => { this.zoom = null; this.draw(); });
  }

  drag([x0, y0], [x1, y1]) {
    const box = { x: Math.min(x0, x1), y: Math.min(y0, y1), width: Math.abs(x1 - x0), height: Math.abs(y1 - y0), visibility: "visible" };
    for (const key in box) this.frame.setAttribute(key, box[key]);
  }

  zoomTo([x0, y0], [x1, y1]) {
    if (Math.abs(x1 - x0) < 8 || Math.abs(y1 - y0) < 8) return this.draw();
    this.zoom = [[this.x.back(Math.min(x0, x1)), this.x.back(Math.max(x0, x1))],
      [this.y.back(Math.max(y0, y1)), this.y.back(Math.min(y0, y1))]];
    this.draw();
  }

  hover([px, py]) {
    let best = null, nearest = 40 ** 2;
    for (const s of this.seen()) s.x.forEach((value, i) => {
      const x = this.x.at(value), y = this.y.at(s.y[i]), away = (x - px) ** 2 + (y - py) ** 2;
      if (away < nearest) { nearest = away; best = { s, i, x, y }; }
    });
    this.point(best);
  }

  point(best) {
    this.tip.hidden = !best;
    if (this.spot) this.spot.setAttribute("visibility", best ? "visible" : "hidden");
    if (!best) return;
    this.spot.setAttribute("cx", best.x); this.spot.setAttribute("cy", best.y);
    this.tip.replaceChildren();
    for (const line of best.s.tip(best.i)) part("div", this.tip, line);
    const right = best.x > this.size.width / 2;
    this.tip.style.left = right ? "" : `${best.x + 14}px`;
    this.tip.style.right = right ? `${this.size.width - best.x + 14}px` : "";
    this.tip.style.top = `${Math.max(0, best.y - 20)}px`;
  }
}

// One button per series; a click hides it.
function legend(host, chart, series) {
  const row = part("div", host, undefined, "legend");
  for (const s of series) {
    const button = part("button", row);
    part("i", button).style.background = s.colour;
    button.append(s.label);
    button.onclick = () => {
      if (!chart.hidden.delete(s.label)) chart.hidden.add(s.label);
      button.classList.toggle("off", chart.hidden.has(s.label));
      chart.draw();
    };
  }
}
