// Wires a report: one time, one time window, and the links from criteria to their curves.
function setUpShared(data) {
  const ends = data.axis
    ? [data.axis.start, data.axis.start + (data.axis.count - 1) * data.axis.step]
    : data.motion ? [data.motion.times[0], data.motion.times[data.motion.times.length - 1]] : [0, 1];
  const shared = {
    time: Math.max(ends[0], 0), from: ends[0], to: ends[1], onTime: [], onWindow: [],
    goTo(time) {
      shared.time = Math.min(ends[1], Math.max(ends[0], time));
      for (const act of shared.onTime) act();
    },
    window(from, to) {
      const least = (ends[1] - ends[0]) / 500;
      const size = Math.min(ends[1] - ends[0], Math.max(to - from, least));
      shared.from = Math.min(Math.max(from, ends[0]), ends[1] - size);
      shared.to = shared.from + size;
      for (const act of shared.onWindow) act();
    },
    zoom(factor) {
      const half = ((shared.to - shared.from) * factor) / 2;
      const centre = shared.time >= shared.from && shared.time <= shared.to ? shared.time : (shared.from + shared.to) / 2;
      shared.window(centre - half, centre + half);
    },
    whole() {
      shared.window(ends[0], ends[1]);
    },
  };
  return shared;
}

function setUpLinks(report, data, shared) {
  for (const link of report.querySelectorAll("a.jump")) {
    link.addEventListener("click", (event) => {
      const figure = document.getElementById(link.dataset.chart);
      if (!figure) return;
      event.preventDefault();
      for (const other of report.querySelectorAll(".chart.selected")) other.classList.remove("selected");
      figure.classList.add("selected");
      const channel = data.channels.find((c) => c.name === figure.dataset.channel);
      if (channel && channel.peak) {
        if (channel.peak[0] < shared.from || channel.peak[0] > shared.to) shared.whole();
        shared.goTo(channel.peak[0]);
      }
      figure.focus({ preventScroll: true });
      figure.scrollIntoView({ block: "center" });
    });
  }
}

// Charts over time that were drawn beforehand: their axis is read from two of its marks.
function setUpTimed(report, shared) {
  for (const svg of report.querySelectorAll("[data-timed] svg")) {
    const marks = [...svg.querySelectorAll(".xticks text")].map((mark) => [Number(mark.getAttribute("x")), Number(mark.textContent.replace("−", "-"))]);
    if (marks.length < 2) continue;
    const [[left, first], [right, last]] = [marks[0], marks[marks.length - 1]];
    const scale = (right - left) / (last - first);
    const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
    const line = element("line", { class: "cursor", y1: 30, y2: height - 22 }, svg);
    shared.onTime.push(() => {
      const x = left + (shared.time - first) * scale;
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
      line.style.visibility = x < 45 || x > width - 13 ? "hidden" : "visible";
    });
    svg.style.cursor = "crosshair";
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect();
      shared.goTo(first + (((event.clientX - box.left) * width) / box.width - left) / scale);
    });
  }
}

for (const report of document.querySelectorAll("[data-report]")) {
  const source = report.querySelector("script[data-result]");
  if (!source) continue;
  const data = JSON.parse(source.textContent);
  for (const channel of data.channels) {
    const unit = 10 ** (channel.decimals + 1);
    channel.values = summed(channel.steps).map((v) => v / unit);
    if (channel.model) channel.model = summed(channel.model).map((v) => v / unit);
  }
  const shared = setUpShared(data);
  setUpCurves(report, data, shared);
  setUpMotion(report, data, shared);
  setUpLinks(report, data, shared);
  setUpTimed(report, shared);
  shared.whole();
  shared.goTo(shared.time);
}

// A link into a closed report of a suite opens it first.
const openFor = () => {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const chapter = target && target.closest("details.chapter");
  if (!chapter) return;
  chapter.open = true;
  target.scrollIntoView();
};
openFor();
addEventListener("hashchange", openFor);
for (const link of document.querySelectorAll(".index a")) link.addEventListener("click", () => setTimeout(openFor));

// A table that fits needs no tab stop; one that scrolls sideways does.
const stops = () => {
  for (const box of document.querySelectorAll(".scroll")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
};
stops();
addEventListener("resize", stops);

const toggle = document.querySelector("[data-theme-toggle]");
toggle.hidden = false;
const dark = () => {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};
const label = () => {
  toggle.textContent = dark() ? toggle.dataset.light : toggle.dataset.dark;
  toggle.setAttribute("aria-label", dark() ? toggle.dataset.toLight : toggle.dataset.toDark);
};
toggle.addEventListener("click", () => {
  document.documentElement.dataset.theme = dark() ? "light" : "dark";
  label();
});
label();
