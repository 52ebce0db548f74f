// Time histories: a shared cursor and a shared time window over all charts of one report.
// Geometry is that of charts/axes.py: the drawing area starts 46 px from the left, ends 14 px from the right,
// 28 px from the top and 22 px from the bottom.
const SVG = "http://www.w3.org/2000/svg";
const READING = 112; // px that the reading of the cursor takes

function element(name, attributes, parent) {
  const node = document.createElementNS(SVG, name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (parent) parent.append(node);
  return node;
}

function summed(steps) {
  let sum = 0;
  return steps.map((step) => (sum += step));
}

function valueAt(channel, axis, time) {
  const place = Math.min(Math.max((time - axis.start) / axis.step, 0), channel.values.length - 1);
  const index = Math.min(Math.floor(place), channel.values.length - 2);
  const part = place - index;
  return channel.values[index] * (1 - part) + channel.values[index + 1] * part;
}

function written(value, decimals) {
  const text = value.toFixed(decimals);
  return (/^-0(\.0*)?$/.test(text) ? text.slice(1) : text).replace("-", "−");
}

function roundTicks(low, high, most) {
  const raw = (high - low) / (most - 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((f) => f * power).find((s) => s >= raw * 0.999);
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i <= Math.floor(high / step + 1e-9); i++) found.push(+(i * step).toPrecision(12));
  return found;
}

function setUpCurve(figure, channel, axis, shared) {
  const svg = figure.querySelector("svg");
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  const box = { left: 46, right: width - 14, top: 28, bottom: height - 22 };
  const [low, high] = channel.range;
  const y = (v) => box.bottom - ((v - low) / (high - low)) * (box.bottom - box.top);
  const x = (t) => box.left + ((t - shared.from) / (shared.to - shared.from)) * (box.right - box.left);
  const timeOf = (px) => shared.from + ((px - box.left) / (box.right - box.left)) * (shared.to - shared.from);
  const curve = svg.querySelector(".curve");
  const marks = svg.querySelector(".xticks");
  const peak = svg.querySelector(".peak");
  const bands = channel.band ? [...svg.querySelectorAll("path.limit")] : [];
  const drag = element("rect", { class: "drag", y: box.top, height: box.bottom - box.top, width: 0 }, svg);
  const line = element("line", { class: "cursor", y1: box.top, y2: box.bottom }, svg);
  const dot = element("circle", { class: "cursor-dot", r: 3 }, svg);
  const readout = element("text", { class: "readout", "aria-hidden": "true" }, svg);

  // The reading stands in the first corner that the curve and its peak leave free, from the upper right one on.
  function placeReadout() {
    const times = Array.from({ length: 61 }, (_, k) => shared.from + ((shared.to - shared.from) * k) / 60);
    const points = times.map((t) => [x(t), y(valueAt(channel, axis, t))]);
    if (channel.peak) points.push([x(channel.peak[0]), y(channel.peak[1])]);
    const corners = [[true, true], [false, true], [true, false], [false, false]];
    const free = corners.find(([right, above]) => !points.some(([a, b]) =>
      (right ? a > box.right - READING : a < box.left + READING) && (above ? b < box.top + 18 : b > box.bottom - 18)));
    const [right, above] = free || corners[0];
    readout.setAttribute("x", right ? box.right : box.left + 4);
    readout.setAttribute("y", above ? box.top + 11 : box.bottom - 5);
    readout.setAttribute("text-anchor", right ? "end" : "start");
  }

  // At most two points a pixel: the lowest and the highest of what falls together.
  function trace(values, times) {
    const found = [];
    const stride = Math.max(1, Math.floor(values.length / 1200));
    for (let i = 0; i < values.length; i += stride) {
      const t = times(i);
      if (t < shared.from || t > shared.to) continue;
      found.push([x(t), y(values[i])]);
    }
    return found;
  }
  const drawn = (points) => (points.length ? "M" + points.map(([a, b]) => `${a.toFixed(1)} ${b.toFixed(1)}`).join("L") : "");

  function draw() {
    curve.setAttribute("d", drawn(trace(channel.values, (i) => axis.start + i * axis.step)));
    bands.forEach((band, i) => {
      const points = channel.band.filter((l) => l.length)[i] || [];
      band.setAttribute("d", drawn(trace(points.map((p) => p[1]), (k) => points[k][0])));
    });
    marks.replaceChildren();
    for (const t of roundTicks(shared.from, shared.to, 7)) {
      element("line", { class: "zero", x1: x(t), x2: x(t), y1: box.bottom, y2: box.bottom + 4 }, marks);
      element("text", { class: "tick", x: x(t), y: box.bottom + 15, "text-anchor": "middle" }, marks).textContent = String(t).replace("-", "−");
    }
    if (peak) {
      const [t] = channel.peak;
      const inside = t >= shared.from && t <= shared.to;
      peak.setAttribute("cx", x(t));
      peak.setAttribute("display", inside ? "inline" : "none");
    }
    placeReadout();
    point();
  }

  function point() {
    const t = shared.time;
    const value = valueAt(channel, axis, t);
    const inside = t >= shared.from && t <= shared.to;
    for (const node of [line, dot]) node.setAttribute("display", inside ? "inline" : "none");
    line.setAttribute("x1", x(t));
    line.setAttribute("x2", x(t));
    dot.setAttribute("cx", x(t));
    dot.setAttribute("cy", y(value));
    readout.textContent = `${written(t, 1)} ms: ${written(value, channel.decimals)} ${channel.unit}`;
  }

  const pixel = (event) => {
    const frame = svg.getBoundingClientRect();
    return Math.min(box.right, Math.max(box.left, ((event.clientX - frame.left) / frame.width) * width));
  };
  let start = null;
  svg.addEventListener("pointerdown", (event) => {
    start = pixel(event);
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointermove", (event) => {
    if (start === null) return;
    const here = pixel(event);
    drag.setAttribute("x", Math.min(start, here));
    drag.setAttribute("width", Math.abs(here - start));
  });
  const end = (event) => {
    if (start === null) return;
    const here = pixel(event);
    if (event.type === "pointerup") {
      if (Math.abs(here - start) > 8) shared.window(timeOf(Math.min(start, here)), timeOf(Math.max(start, here)));
      else shared.goTo(timeOf(here));
    }
    start = null;
    drag.setAttribute("width", 0);
  };
  svg.addEventListener("pointerup", end);
  svg.addEventListener("pointercancel", end);
  svg.addEventListener("dblclick", () => shared.whole());
  figure.tabIndex = 0;
  figure.setAttribute("role", "group");
  figure.setAttribute("aria-label", figure.closest("[data-keys]").dataset.keys.replace("{channel}", channel.title));
  figure.dataset.live = "";
  figure.addEventListener("keydown", (event) => {
    const step = (shared.to - shared.from) / (event.shiftKey ? 20 : 100);
    const keys = {
      ArrowLeft: () => shared.goTo(shared.time - step),
      ArrowRight: () => shared.goTo(shared.time + step),
      "+": () => shared.zoom(0.5),
      "-": () => shared.zoom(2),
      0: () => shared.whole(),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  shared.onTime.push(point);
  shared.onWindow.push(draw);
}

function setUpCurves(report, data, shared) {
  if (!data.axis) return;
  for (const figure of report.querySelectorAll("[data-channel]")) {
    const channel = data.channels.find((c) => c.name === figure.dataset.channel);
    if (channel) setUpCurve(figure, channel, data.axis, shared);
  }
  const tools = report.querySelector("[data-tools]");
  if (!tools) return;
  tools.hidden = false;
  const zooms = {
    in: () => shared.zoom(0.5),
    out: () => shared.zoom(2),
    all: () => shared.whole(),
    interval: () => shared.window(data.interval[0], data.interval[1]),
  };
  for (const button of tools.querySelectorAll("[data-zoom]")) button.addEventListener("click", zooms[button.dataset.zoom]);
}
