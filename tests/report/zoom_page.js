// A page of a few objects, in which zoom.js runs; test_zoom.py says what stands for its words in capitals.
const element = () => ({ listeners: {}, style: {}, classList: { toggle() {} }, clientWidth: WIDTH,
  addEventListener(name, what) { this.listeners[name] = what; }, prepend() {}, after() {} });
const tools = element(), hint = element(), figure = element(), button = element(), made = [];
tools.querySelector = (what) => (what === "a" ? { href: TABLE } : hint);
figure.querySelector = (what) => (what === "svg" ? element() : tools);
figure.dataset = { panels: PANELS };
globalThis.window = element();
globalThis.getComputedStyle = () => ({ getPropertyValue: () => "black" });
globalThis.matchMedia = () => element();
globalThis.document = { querySelectorAll: () => [figure], createElement: (what) => (what === "button" ? button : element()) };
globalThis.uPlot = class {
  constructor(options, data) {
    const x = data[0];
    this.log = options.scales.x.distr === 3; this.scales = { x: { min: x[0], max: x[x.length - 1] } };
    this.over = Object.assign(element(), { getBoundingClientRect: () => ({ left: 30 }) });
    made.push(this); options.hooks.ready.forEach((h) => h(this));
  }
  posToVal(p) {
    const to = this.log ? Math.log10 : (v) => v, { min, max } = this.scales.x;
    const t = to(min) + (to(max) - to(min)) * p / WIDTH;
    return this.log ? 10 ** t : t;
  }
  setScale(_, range) { this.scales.x = range; }
  destroy() {}
};
SCRIPT
button.listeners.click();
const touch = (name, ...places) => made[0].over.listeners[name](
  { touches: places.map((p) => ({ clientX: p + 30 })), cancelable: true, preventDefault() {} });
for (const [name, ...places] of GESTURE) touch(name, ...places);
console.log(JSON.stringify(made.map((u) => u.scales.x)));
