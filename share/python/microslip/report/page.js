// What this page shows: curves, peaks over the preload, contact maps over a period.

const data = JSON.parse(document.getElementById("data").textContent);
const host = (name) => document.querySelector(`[data-chart=${name}]`);

function choice(parent, entries, chosen, then) {
  const buttons = entries.map((entry, i) => {
    const button = part("button", parent, entry.label);
    button.onclick = () => { buttons.forEach((b, k) => b.setAttribute("aria-pressed", k === i)); then(entry); };
    button.setAttribute("aria-pressed", i === chosen);
    return button;
  });
}

// What friction dissipates where nothing slips is rounding, many decades lower.
const DECADES = { dissipated_energy: 4 };

function curveSeries(curve, quantity) {
  const values = curve.values[quantity.key] || curve.frequency.map(() => null), last = values.length - 1;
  const state = { "1": "stable", "0": "unstable", "-1": "stability not judged" };
  const mark = curve.mark.map((m, i) => (m === "peak" || m === "fold" ? m : !curve.complete && i === last ? "end" : ""));
  return { label: curve.label, colour: curve.colour, width: curve.limit ? 2.6 : 1.7, x: curve.frequency, y: values, mark,
    kind: curve.stable, bar: quantity.key === "amplitude" ? curve.bar : null,
    between: curve.between[quantity.key],
    // A frequency is given, but where it was solved for.
    tip: (i) => [curve.label + (curve.mark[i] ? `: ${curve.mark[i]}` : ""), `${told(curve.frequency[i], curve.mark[i] ? curve.digits.frequency : 7)} Hz`,
      ...data.quantities.filter((q) => curve.values[q.key] && curve.values[q.key][i] !== null)
        .map((q) => `${q.short}: ${told(curve.values[q.key][i], curve.digits[q.key] || 3)}`), state[curve.stable[i]]] };
}

function showCurves() {
  const place = host("curves");
  if (!place) return;
  const tools = document.querySelector("[data-tools=curves]");
  const chart = new Chart(place, { x: "excitation frequency [Hz]" });
  const richer = (quantity) => (quantity.key === "amplitude" ? data.curves.filter((curve) => curve.richer).map(richerSeries) : []);
  const show = (quantity) => chart.show([...data.curves.map((curve) => curveSeries(curve, quantity)), ...richer(quantity)],
    { y: quantity.label, yLog: quantity.log, decades: DECADES[quantity.key] });
  choice(tools, data.quantities.map((q) => ({ ...q, label: q.short, axis: q.label })), 0, (q) => show({ ...q, label: q.axis }));
  show(data.quantities[0]);
  const peaks = part("select", tools);
  part("option", peaks, "zoom on …");
  const places = data.curves.flatMap((curve) => offerPeaks(peaks, curve));
  peaks.onchange = () => { zoomOnPeak(chart, ...places[peaks.selectedIndex - 1]); peaks.selectedIndex = 0; };
  part("button", tools, "whole range").onclick = () => { chart.zoom = null; chart.draw(); };
  legend(place.parentNode.insertBefore(part("div"), place.nextSibling), chart, data.curves);
}

// From the highest peak to where more harmonics put it.
function richerSeries({ label, colour, richer, digits }) {
  return { label, colour, width: 1, x: richer.frequency, y: richer.amplitude, kind: [-1, -1], mark: ["", "richer"],
    tip: () => [`${label}: the peak with ${richer.harmonics} harmonics`, `${told(richer.frequency[1], digits.frequency)} Hz`,
      `${told(richer.amplitude[1], digits.amplitude)} ${data.unit}`] };
}

const placeOf = (amplitude, frequency, digits) => `${told(amplitude, digits.amplitude)} ${data.unit} at ${told(frequency, digits.frequency)} Hz`;

// Every peak of a curve as an entry of the list; of a curve without one its highest point. Gives [curve, point] of each.
function offerPeaks(list, curve) {
  const high = curve.values.amplitude, group = part("optgroup", list);
  const peaks = [...high.keys()].filter((i) => curve.mark[i] === "peak");
  if (!peaks.length && high.length) peaks.push(high.indexOf(high.reduce((a, b) => Math.max(a, b))));
  group.label = curve.label;
  peaks.forEach((i) => part("option", group, `${curve.label}: ${placeOf(high[i], curve.frequency[i], curve.digits)}`));
  return peaks.map((i) => [curve, i]);
}

// As wide as the peak is at half of its height, and some more; not as far as a peak of twice the height.
function zoomOnPeak(chart, { frequency, values: { amplitude } }, peak) {
  const centre = frequency[peak], beside = (i) => amplitude[i] > 0.5 * amplitude[peak] && amplitude[i] < 2 * amplitude[peak];
  let from = peak, to = peak;
  while (from > 0 && beside(from - 1)) --from;
  while (to + 1 < frequency.length && beside(to + 1)) ++to;
  const width = frequency.slice(from, to + 1).reduce((w, f) => Math.max(w, Math.abs(f - centre)), 1e-4 * centre);
  const x = [centre - 2 * width, centre + 2 * width];
  const inside = chart.seen().flatMap((s) => s.y.filter((v, i) => s.x[i] >= x[0] && s.x[i] <= x[1]));
  chart.zoom = [x, rangeOf(inside, chart.names.yLog, 0.08, chart.names.decades)];
  chart.draw();
}

// Peaks of one sign of the preload, with the limits as lines; `what` is amplitude or frequency.
const opens = () => data.peaks.filter((p) => p.preload !== null && p.preload < 0);
const gapsKnown = () => opens().every((p) => p.gap !== null);

function peakSeries(what, sign) {
  const family = sign > 0 ? data.peaks.filter((p) => p.preload !== null && p.preload > 0) : opens();
  const place = (p) => (sign < 0 && gapsKnown() ? p.gap : sign * p.preload);
  const at = (p) => [`${p.label}: ${placeOf(p.amplitude, p.frequency, p.digits)}`];
  const points = family.map((p) => ({ label: p.label, colour: p.colour, x: [place(p)], y: [p[what]], kind: [1],
    mark: ["dot"], tip: () => at(p) }));
  const trace = sign > 0 && data.trace && data.trace.parameter === "preload" ? [traceSeries(what)] : [];
  const range = [...points, ...trace].flatMap((s) => s.x);
  if (!range.length) return [];
  const ends = rangeOf(range, true, 0);  // of one value: some way about it
  const lowest = (p) => data.peaks.every((q) => q.preload !== null || q[what] >= p[what]);
  const limits = data.peaks.filter((p) => p.preload === null).map((p) => ({ label: p.label, name: p.label, below: lowest(p), colour: p.colour, width: 1.4, x: ends,
    y: [p[what], p[what]], kind: [1, 1], mark: ["", ""], tip: () => at(p) }));
  return [...limits, ...trace, ...points, ...bestSeries(what, sign > 0 && data.trace && data.trace.parameter === "preload")];
}

function traceSeries(what) {
  const t = data.trace, at = (i) => [`search: ${told(t.value[i])}`, placeOf(t.amplitude[i], t.frequency[i], t.digits)];
  return { label: "search", colour: "#5b6570", width: 1.2, x: t.value, y: t[what], kind: t.value.map(() => 1), mark: t.value.map(() => ""), tip: at };
}

function bestSeries(what, wanted) {
  const best = wanted && data.trace.best;
  return best ? [{ label: "best", colour: "#c1121f", x: [best.value], y: [best[what]], kind: [1], mark: ["best"],
    tip: () => [`best: ${told(best.value, data.trace.digits.value)}`, placeOf(best.amplitude, best.frequency, data.trace.digits)] }] : [];
}

function showPeaks() {
  const place = host("peaks");
  if (!place) return;
  const names = { amplitude: `peak amplitude [${data.unit}]`, frequency: "peak frequency [Hz]" };
  const sides = [[1, data.scaled ? "preload scale" : "preload [N]"], [-1, gapsKnown() ? "gap [µm]" : "gap: −preload [N]"]];
  for (const [sign, x] of sides) for (const what in names) addChart(place, peakSeries(what, sign), x, names[what], what, true);
  if (data.trace && data.trace.parameter !== "preload")
    for (const what in names)
      addChart(place, [traceSeries(what), ...bestSeries(what, true)], `${data.trace.parameter} [SI]`, names[what], what, false);
}

function addChart(place, series, x, y, what, xLog) {
  if (!series.some((s) => s.mark.includes("dot") || s.label === "search")) return;
  const chart = new Chart(part("div", place, undefined, "chart"), { x, y, xLog, yLog: what === "amplitude", xPad: 0.05 });
  chart.show(series, {});
}

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const SEQUENTIAL = [[0, 34, 78], [66, 78, 108], [125, 124, 120], [188, 175, 111], [254, 232, 56]];
const DIVERGING = [[44, 84, 150], [150, 180, 215], [246, 246, 246], [230, 150, 130], [165, 30, 45]];

function shade(scale, share) {
  const place = share * (scale.length - 1), i = Math.min(Math.floor(place), scale.length - 2);
  return `rgb(${scale[i].map((v, k) => Math.round(v + (place - i) * (scale[i + 1][k] - v)))})`;
}

const words = ({ unit, data: text }) => Array.from(new Int16Array(bytes(text).buffer), (value) => value * unit);
const GUARDS = { slip_guard: ["boundary: slips at times", []], smallest_load: ["boundary: open at times", [6, 3]],
  largest_load: ["boundary: open throughout", [1.5, 2.5]] };

class ContactMap {
  constructor(entry) {
    Object.assign(this, entry);
    this.states = bytes(entry.states);
    this.varying = entry.varying.map((v) => ({ ...v, data: bytes(v.data) }));
    this.cycles = entry.cycles.map((c) => ({ along: c.along, x: words(c.x), y: words(c.y) }));
    const energy = this.varying.find((v) => v.constant).data;
    this.point = energy.indexOf(energy.reduce((a, b) => Math.max(a, b), 0));  // where most is dissipated
  }

  // Loops of one point, along p and r, closed.
  loopsOf(point, phase) {
    const m = this.phases.length, order = [...this.phases.keys(), 0];
    return this.cycles.map(({ along, x, y }, i) => ({ label: `along ${along}`, colour: ["#12355b", "#c1121f"][i],
      x: order.map((k) => x[point * m + k]), y: order.map((k) => y[point * m + k]), kind: order.map(() => 1),
      mark: order.map((_, k) => (k === phase ? "dot" : "")),
      tip: (k) => [`along ${along}, θ = ${told(this.phases[order[k]], 4)}°`, `${told(x[point * m + order[k]])} µm`,
        `${told(y[point * m + order[k]])} MPa`] }));
  }

  colours(what, phase) {
    if (what < 0) return Array.from({ length: this.n }, (_, i) => data.states[this.states[phase * this.n + i]][1]);
    const { data: values, low, constant } = this.varying[what], from = constant ? 0 : phase * this.n;
    return Array.from({ length: this.n }, (_, i) => shade(low < 0 ? DIVERGING : SEQUENTIAL, values[from + i] / 255));
  }

  shares(phase) {
    const sums = [0, 0, 0, 0, 0];
    this.area.forEach((area, i) => { sums[this.states[phase * this.n + i]] += area; });
    return data.states.map(([name], i) => [name, sums[i]]).filter(([, share]) => share > 0)
      .map(([name, share]) => `${name} ${Math.round(100 * share)} %`).join(", ");
  }

  // The phase with most states.
  liveliest() {
    const counts = this.phases.map((_, k) => new Set(this.states.subarray(k * this.n, (k + 1) * this.n)).size);
    return counts.indexOf(Math.max(...counts));
  }

  draw(canvas, what, phase) {
    const ratio = window.devicePixelRatio || 1, width = (canvas.parentNode.clientWidth || 700) * ratio, pen = canvas.getContext("2d");
    canvas.width = width;
    if (this.cells.length) { this.drawPatch(canvas, pen, this.colours(what, phase), what < 0 && this.parted[phase]); this.drawOver(canvas, pen, what, phase, ratio); }
    else this.drawRows(canvas, pen, what, phase, ratio);
  }

  // Cells in their colours; of those that boundaries part, each part in the colour of its state.
  drawPatch(canvas, pen, colours, parted) {
    const x = this.corners.filter((_, i) => i % 2 === 0), y = this.corners.filter((_, i) => i % 2);
    const [x0, x1, y0, y1] = [rangeOf(x, false, 0), rangeOf(y, false, 0)].flat();
    const scale = Math.min(canvas.width / (x1 - x0), 0.55 * canvas.width / (y1 - y0));
    canvas.height = scale * (y1 - y0);
    this.at = (px, py) => [(px - x0) * scale, canvas.height - (py - y0) * scale];
    const areas = new Map(), add = (colour, corners) => (areas.get(colour) || areas.set(colour, []).get(colour)).push(corners);
    const whole = new Set(this.cells.keys());
    if (parted) {
      parted.cells.forEach((i) => whole.delete(i));
      this.partsOf(parted).forEach(([state, corners]) => add(data.states[state][1], corners));
    }
    for (const i of whole) add(colours[i], this.cells[i].map((corner) => this.at(x[corner], y[corner])));
    areas.forEach((polygons, colour) => this.fillArea(pen, polygons, colour));
  }

  partsOf({ states, sizes, corners }) {
    const flat = words(corners);
    let from = 0;
    return states.map((state, i) => {
      const part = Array.from({ length: sizes[i] }, (_, k) => this.at(flat[from + 2 * k], flat[from + 2 * k + 1]));
      from += 2 * sizes[i];
      return [state, part];
    });
  }

  // As one: side by side, polygons of one colour would show their edges.
  fillArea(pen, polygons, colour) {
    pen.beginPath(); pen.lineJoin = "round";
    for (const corners of polygons) {
      corners.forEach((corner, k) => (k ? pen.lineTo(...corner) : pen.moveTo(...corner)));
      pen.closePath();
    }
    pen.fillStyle = pen.strokeStyle = colour;
    pen.fill(); pen.stroke();
  }

  // Boundaries, arrows and the chosen point, over the cells.
  drawOver(canvas, pen, what, phase, ratio) {
    pen.lineJoin = "round";
    if (what < 0 && this.boundaries.length) this.strokeSegments(pen, this.boundaries[phase], "#000", 1.6 * ratio, []);
    if (what >= 0 && this.varying[what].constant)
      for (const name in this.period) for (const [colour, width] of [["#000", 3], ["#fff", 1.6]])
        this.strokeSegments(pen, this.period[name], colour, width * ratio, GUARDS[name][1].map((v) => v * ratio));
    if (what < 0 && this.arrows.length) this.drawArrows(pen, this.arrows[phase], ratio);
    const [x, y] = this.centre(this.point);
    for (const [colour, width] of [["#fff", 4], ["#c1121f", 2]]) {
      pen.beginPath(); pen.strokeStyle = colour; pen.lineWidth = width * ratio;
      pen.arc(x, y, 5 * ratio, 0, 7); pen.stroke();
    }
  }

  centre(i) {
    const sum = [0, 1].map((k) => this.cells[i].reduce((s, corner) => s + this.corners[2 * corner + k], 0) / this.cells[i].length);
    return this.at(...sum);
  }

  strokeSegments(pen, flat, colour, width, dash) {
    pen.beginPath(); pen.strokeStyle = colour; pen.lineWidth = width; pen.setLineDash(dash);
    for (let i = 0; i + 3 < flat.length; i += 4) { pen.moveTo(...this.at(flat[i], flat[i + 1])); pen.lineTo(...this.at(flat[i + 2], flat[i + 3])); }
    pen.stroke(); pen.setLineDash([]);
  }

  drawArrows(pen, flat, ratio) {
    for (const [colour, width] of [["#000", 3], ["#fff", 1.5]]) {
      pen.beginPath(); pen.strokeStyle = colour; pen.lineWidth = width * ratio;
      for (let i = 0; i + 3 < flat.length; i += 4) {
        const [x, y] = this.at(flat[i], flat[i + 1]), [u, v] = this.at(flat[i] + flat[i + 2], flat[i + 1] + flat[i + 3]);
        const size = Math.hypot(u - x, v - y), head = Math.min(4 * ratio, 0.5 * size), [c, s] = [(u - x) / (size || 1), (v - y) / (size || 1)];
        pen.moveTo(x, y); pen.lineTo(u, v);
        for (const side of [-1, 1]) { pen.moveTo(u, v); pen.lineTo(u - head * (c - side * s), v - head * (s + side * c)); }
      }
      pen.stroke();
    }
  }

  // Contact point at a place of the canvas.
  nearest(canvas, x, y) {
    if (!this.cells.length) return Math.min(this.n - 1, Math.floor(y / canvas.height * this.n));
    let best = 0, least = Infinity;
    for (let i = 0; i < this.n; ++i) {
      const [cx, cy] = this.centre(i), away = (cx - x) ** 2 + (cy - y) ** 2;
      if (away < least) { least = away; best = i; }
    }
    return best;
  }

  // Points without cells: a row each, the period from left to right.
  drawRows(canvas, pen, what, phase, ratio) {
    const row = Math.max(2, Math.min(24, 360 / this.n)) * ratio, step = canvas.width / this.phases.length;
    canvas.height = row * this.n;
    this.phases.forEach((_, k) => this.colours(what, k).forEach((colour, i) => {
      pen.fillStyle = colour;
      pen.fillRect(k * step, i * row, step + 1, row - (row > 6 ? ratio : 0));
    }));
    pen.fillStyle = "#c1121f";
    pen.fillRect((phase + 0.5) * step, 0, 2 * ratio, canvas.height);
  }

  key(place, what) {
    place.replaceChildren();
    if (what < 0) {
      for (const [name, colour] of data.states) { const entry = part("span", place); part("i", entry).style.background = colour; entry.append(name); }
      if (this.boundaries.length) this.lineKey(place, "boundary of the states at this phase", [], "#000");
      if (this.arrows.length) part("span", place, "→ direction and speed of slip");
      return;
    }
    const { label, low, high } = this.varying[what], stops = (low < 0 ? DIVERGING : SEQUENTIAL).map((c) => `rgb(${c})`);
    part("span", place, `${label}: ${told(low, 3)}`);
    const bar = part("i", place);
    bar.style.cssText = `width:9em;background:linear-gradient(90deg,${stops})`;
    part("span", place, told(high, 3));
    if (this.varying[what].constant) for (const name in this.period) this.lineKey(place, ...GUARDS[name]);
  }

  lineKey(place, label, dash, colour = "#5b6570") {
    const entry = part("span", place), svg = element("svg", { width: 28, height: 8, class: "dash" }, entry);
    element("line", { x1: 0, x2: 28, y1: 4, y2: 4, stroke: colour, "stroke-width": 1.8, "stroke-dasharray": dash.join(" ") }, svg);
    entry.append(label);
  }
}

function showMaps() {
  const place = host("maps");
  if (!place) return;
  const tools = document.querySelector("[data-tools=maps]"), maps = data.maps.map((m) => new ContactMap(m));
  const which = part("select", tools), what = part("select", tools), slider = part("input", tools), play = part("button", tools, "play");
  maps.forEach((m) => part("option", which, `${m.name}, ${told(m.frequency, m.frequency_digits)} Hz`));
  slider.type = "range"; slider.min = 0; slider.value = 0; slider.setAttribute("aria-label", "phase");
  const told_ = part("p", place, undefined, "note"), canvas = part("canvas", part("div", place)), axes = part("p", place, undefined, "note");
  const key = part("div", place, undefined, "key");
  const loop = new Chart(host("loop"), { x: "mean displacement along p [µm]", y: "friction force along p [N]", xPad: 0.05 });
  const own = new Chart(host("point-loop"), { x: "displacement [µm]", y: "friction traction [MPa]", xPad: 0.05 });
  const title = document.querySelector("[data-title=point-loop]");
  const draw = () => {
    const map = maps[which.selectedIndex], phase = Math.min(+slider.value, map.phases.length - 1), chosen = what.selectedIndex - 1;
    map.draw(canvas, chosen, phase);
    loop.show([loopSeries(map, phase)], {});
    own.show(map.loopsOf(map.point, phase), {});
    title.textContent = `Hysteresis of point ${map.point + 1}: ${told(100 * map.area[map.point], 2)} % of the area` +
      (map.cycles.length > 1 ? ", along p (blue) and r (red)" : "");
    map.key(key, chosen);
    told_.textContent = `${which.value}, ${what.value}; θ = ${told(map.phases[phase], 4)}°: ${map.shares(phase)} of the area`;
    axes.textContent = map.cells.length ? `${map.axes[0]} to the right, ${map.axes[1]} upwards; ${sizeOf(map)}`
      : `${map.n} contact points from above, one period from left to right`;
  };
  const choose = () => {
    const map = maps[which.selectedIndex];
    slider.max = map.phases.length - 1;
    slider.value = map.liveliest();
    what.replaceChildren();
    for (const label of ["state", ...map.varying.map((v) => v.label)]) part("option", what, label);
    draw();
  };
  which.selectedIndex = liveliest(maps);
  which.onchange = choose; what.onchange = draw; slider.oninput = draw;
  canvas.onclick = (event) => {
    const box = canvas.getBoundingClientRect(), map = maps[which.selectedIndex], ratio = canvas.width / box.width;
    map.point = map.nearest(canvas, (event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio);
    draw();
  };
  playWith(play, slider, draw);
  new ResizeObserver(draw).observe(place);
  choose();
}

function loopSeries({ loop, phases }, phase) {
  const here = loop.phases.indexOf(phases[phase]);
  return { label: "loop", colour: "#12355b", x: loop.x, y: loop.y, kind: loop.x.map(() => 1),
    mark: loop.x.map((_, i) => (i === here ? "dot" : "")),
    tip: (i) => [`θ = ${told(loop.phases[i], 4)}°`, `${told(loop.x[i])} µm`, `${told(loop.y[i])} N`] };
}

// The map with most states: the first may be open, or stick, all over.
function liveliest(maps) {
  const counts = maps.map((map) => new Set(map.states).size);
  return counts.indexOf(Math.max(...counts));
}

function sizeOf(map) {
  const [x, y] = [0, 1].map((k) => rangeOf(map.corners.filter((_, i) => i % 2 === k), false, 0));
  return `${told(x[1] - x[0], 4)} × ${told(y[1] - y[0], 4)} mm`;
}

function playWith(button, slider, draw) {
  let timer = null;
  button.onclick = () => {
    button.textContent = timer ? "play" : "stop";
    if (timer) { clearInterval(timer); timer = null; return; }
    timer = setInterval(() => { slider.value = (+slider.value + 1) % (+slider.max + 1); draw(); }, 80);
  };
}

showCurves();
showPeaks();
showMaps();
