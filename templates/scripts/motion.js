// The moving picture: shapes on recorded poses and lines through recorded points, coloured by bending moment,
// with gauges that follow. A player has one stage or several; a stage names whose lines it shows.
const ANCHORS = [[8, 69, 148], [107, 163, 209], [232, 230, 224], [240, 155, 84], [166, 47, 14]];
const ORDER = ["ground", "rig", "flesh", "mass", "knee", "bone", "honeycomb", "ram", "vehicle"];
const SECONDS = 8; // the whole test at speed 1
const STILLS = 9; // instants that are shown instead of a motion

function diverging(fraction) {
  const place = (Math.min(1, Math.max(-1, fraction)) + 1) * 2;
  const index = Math.min(Math.floor(place), 3);
  const part = place - index;
  return `rgb(${ANCHORS[index].map((a, i) => Math.round(a + (ANCHORS[index + 1][i] - a) * part)).join(" ")})`;
}

// One row a frame from one column a coordinate, each column written as the steps of its steps.
function unpacked(columns, times) {
  const whole = columns.map((column) => summed(summed(column)));
  return times.map((_, frame) => whole.map((column) => column[frame]));
}

// A value between two frames.
const mixed = (row, other, k, part) => row[k] * (1 - part) + other[k] * part;

function drawnShape(shape, fill, parent) {
  const data = "M" + shape.outline.map(([a, b]) => `${a * 1000} ${-b * 1000}`).join("L") + (shape.closed ? "z" : "");
  return element("path", {
    class: `k-${shape.kind}`, d: data, fill: shape.closed ? fill : "none", "fill-opacity": ["honeycomb", "ram", "vehicle"].includes(shape.kind) ? 0.7 : 1, "stroke-width": shape.closed ? 1.2 : 2.5, "stroke-linejoin": "round",
  }, parent);
}

// Returns what draws an instant: frame, the next one, and the part of the way between them.
function setUpStage(stage, motion) {
  const [left, right, low, high] = motion.box.map((v) => v * 1000);
  const svg = element("svg", {
    viewBox: `${left} ${-high} ${right - left} ${high - low}`, role: "img", "aria-label": stage.dataset.words,
  }, stage);
  const sides = (stage.dataset.stage || "").split(" ");
  const frames = unpacked(motion.poses, motion.times);
  for (const shape of motion.scene) drawnShape(shape, motion.fill[shape.kind], svg);
  const sorted = motion.shapes.map((shape, index) => ({ shape, index }));
  sorted.sort((a, b) => ORDER.indexOf(a.shape.kind) - ORDER.indexOf(b.shape.kind) || a.index - b.index);
  const drawn = sorted.map(({ shape, index: body }) => {
    const path = drawnShape(shape, motion.fill[shape.kind], svg);
    const joint = motion.moments.length ? motion.joints.indexOf(shape.name) : -1;
    return (index, next, part) => {
      const [x, z, angle] = [0, 1, 2].map((k) => mixed(frames[index], frames[next], 3 * body + k, part) * motion.unit);
      path.setAttribute("transform", `translate(${(x * 1000).toFixed(2)} ${(-z * 1000).toFixed(2)}) rotate(${((-angle * 180) / Math.PI).toFixed(3)})`);
      if (joint >= 0) path.setAttribute("fill", diverging(mixed(motion.moments[index], motion.moments[next], joint, part) / motion.peak));
    };
  });
  if (motion.bars) {
    const [x, scale, force] = [motion.bars[0] * 1000, motion.bars[1] * 1000, motion.bars[2]];
    const foot = -low - 14;
    element("path", { class: "m-base", d: `M${x} ${-high + 14}V${foot - 34}M${x} ${foot - 5}v10M${x} ${foot}h${(force * scale).toFixed(1)}m0 -5v10` }, svg);
    element("text", { class: "m-name", x, y: foot - 10, "aria-hidden": "true" }, svg).textContent = `${force / 1000} kN`;
  }
  for (const line of motion.lines || []) {
    for (const side of sides) if (line[side]) drawn.push(drawnLine(line, side, sides.length > 1, motion, svg));
  }
  return drawn;
}

// A line through moving points; a leg alone on its stage is coloured piece by piece.
function drawnLine(line, side, several, motion, svg) {
  const frames = unpacked(line[side].places, motion.times);
  const moments = several ? null : line[side].moments;
  const css = `m-${line.kind}${several ? ` m-${side}` : ""}${line.marked && !several ? " m-marked" : ""}`;
  const path = element("path", { class: css, "data-line": line.name }, svg);
  const ground = moments ? element("path", { class: "m-piece", stroke: diverging(0) }, svg) : null;
  const pieces = moments ? moments[0].map(() => element("path", { class: "m-piece" }, svg)) : [];
  const name = line.words && !several ? element("text", { class: `m-name${line.marked ? " m-marked" : ""}`, "aria-hidden": "true" }, svg) : null;
  if (name) name.textContent = line.words;
  const forces = motion.bars && line[side].forces;
  const bar = forces ? element("rect", { class: `m-force m-of-${side}`, x: motion.bars[0] * 1000, y: -line.middle * 1000 - (several && side === "model" ? 0 : several ? 13 : 7), height: several ? 12 : 14 }, svg) : null;
  return (index, next, part) => {
    if (bar) bar.setAttribute("width", ((forces[index] * (1 - part) + forces[next] * part) * motion.bars[1] * 1000).toFixed(1));
    const points = [];
    for (let k = 0; k < frames[0].length; k += 2) {
      points.push([0, 1].map((c) => mixed(frames[index], frames[next], k + c, part) * motion.unit * 1000));
    }
    const written = points.map(([x, z]) => `${x.toFixed(1)} ${(-z).toFixed(1)}`);
    path.setAttribute("d", `M${written.join("L")}${line.closed ? "z" : ""}`);
    if (ground) ground.setAttribute("d", path.getAttribute("d"));
    pieces.forEach((piece, k) => {
      piece.setAttribute("d", `M${written[k]}L${written[k + 1]}`);
      piece.setAttribute("stroke", diverging(mixed(moments[index], moments[next], k, part) / motion.peak));
    });
    if (!name) return;
    const [x, z] = line.closed
      ? [0, 1].map((c) => points.reduce((sum, point) => sum + point[c], 0) / points.length)
      : points[Math.floor((points.length - 1) / 2)];
    name.setAttribute("x", (x + (line.closed ? -12 : 14)).toFixed(1));
    name.setAttribute("y", (8 - z).toFixed(1));
  };
}

function setUpGauges(body, data) {
  return data.channels.map((channel) => {
    const row = body.insertRow();
    const head = document.createElement("th");
    head.scope = "row";
    head.textContent = channel.label || channel.name;
    head.title = channel.title;
    const value = row.appendChild(head) && row.insertCell();
    value.className = "n";
    value.dataset.gauge = channel.name;
    const beside = channel.model ? row.insertCell() : null;
    if (beside) beside.className = "n";
    const unit = row.insertCell();
    unit.className = "unit";
    unit.textContent = channel.unit;
    const [low, high] = channel.range;
    const share = (v) => `${Math.min(100, Math.max(0, ((v - low) / (high - low)) * 100))}%`;
    const meter = row.insertCell().appendChild(document.createElement("div"));
    meter.className = "meter";
    if (channel.limits.length === 2) {
      const corridor = meter.appendChild(document.createElement("i"));
      corridor.style.left = share(channel.limits[0]);
      corridor.style.right = `calc(100% - ${share(channel.limits[1])})`;
    }
    const needle = meter.appendChild(document.createElement("b"));
    const other = channel.model ? meter.appendChild(document.createElement("b")) : null;
    if (other) other.className = "second";
    return (time) => {
      const now = valueAt(channel, data.axis, time);
      value.textContent = written(now, channel.decimals);
      needle.style.left = share(now);
      if (!other) return;
      const there = valueAt({ values: channel.model }, data.axis, time);
      beside.textContent = written(there, channel.decimals);
      other.style.left = share(there);
    };
  });
}

function setUpMotion(report, data, shared) {
  const player = report.querySelector("[data-player]");
  const motion = data.motion;
  if (!player || !motion) return;
  player.hidden = false;
  report.querySelector("[data-stills]").hidden = true;
  const last = motion.times[motion.times.length - 1];
  const first = motion.times[0];
  const parts = [...player.querySelectorAll("[data-stage]")].flatMap((stage) => setUpStage(stage, motion));
  const gauges = data.axis ? setUpGauges(player.querySelector("[data-gauges]"), data) : [];
  const clock = player.querySelector("[data-time]");
  const scrub = player.querySelector("[data-scrub]");
  const play = player.querySelector("[data-play]");
  const still = play.textContent;
  const speed = player.querySelector("[data-speed]");
  scrub.min = first;
  scrub.max = last;
  scrub.step = Math.max((last - first) / 1000, 0.001);

  function show() {
    const time = Math.min(last, Math.max(first, shared.time));
    let next = motion.times.findIndex((t) => t >= time);
    if (next < 0) next = motion.times.length - 1;
    const index = Math.max(0, next - 1);
    const gap = motion.times[next] - motion.times[index];
    const part = gap > 0 ? (time - motion.times[index]) / gap : 0;
    for (const draw of parts) draw(index, next, part);
    for (const gauge of gauges) gauge(shared.time);
    clock.textContent = written(shared.time, 1);
    scrub.value = shared.time;
    scrub.setAttribute("aria-valuetext", `${written(shared.time, 1)} ${scrub.dataset.unit}`);
  }

  const steady = matchMedia("(prefers-reduced-motion: reduce)");
  let running = 0;
  let before = 0;
  let reached = first;
  let shown = first;
  function tick(now) {
    if (!running) return;
    const rate = ((last - first) / (SECONDS * 1000)) * Number(speed.value);
    if (shared.time !== shown) reached = shared.time; // somebody moved it meanwhile
    reached += before ? (now - before) * rate : 0;
    before = now;
    if (reached >= last) {
      shared.goTo(last);
      stop();
      return;
    }
    // Who asked for less motion is shown a few instants one after the other.
    if (!steady.matches || reached - shared.time >= (last - first) / STILLS) shared.goTo(reached);
    shown = shared.time;
    running = requestAnimationFrame(tick);
  }
  function stop() {
    cancelAnimationFrame(running);
    running = 0;
    play.textContent = still;
  }
  play.addEventListener("click", () => {
    if (running) {
      stop();
      return;
    }
    if (shared.time >= last - 1e-9) shared.goTo(first);
    before = 0;
    reached = shown = shared.time;
    play.textContent = play.dataset.pause;
    running = requestAnimationFrame(tick);
  });
  scrub.addEventListener("input", () => {
    stop();
    shared.goTo(Number(scrub.value));
  });
  for (const button of player.querySelectorAll("[data-step]")) {
    button.addEventListener("click", () => {
      stop();
      const forward = Number(button.dataset.step) > 0;
      const later = motion.times.find((t) => t > shared.time + 1e-6);
      const earlier = motion.times.filter((t) => t < shared.time - 1e-6).pop();
      shared.goTo((forward ? later : earlier) ?? (forward ? last : first));
    });
  }
  const overlay = player.querySelector("[data-overlay]");
  if (overlay) {
    overlay.addEventListener("click", () => {
      const laid = player.toggleAttribute("data-laid-over");
      overlay.setAttribute("aria-pressed", String(laid));
    });
  }
  const told = player.querySelector("[data-slow]");
  const tell = () => {
    const times = (SECONDS * 1000) / (last - first) / Number(speed.value);
    told.textContent = times > 1.5 ? told.dataset.slow.replace("{times}", Math.round(times)) : "";
  };
  speed.addEventListener("change", tell);
  tell();
  shared.onTime.push(show);
}
