// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// The page: takes frames and options, asks the worker, and shows the report.
"use strict";

const part = (id) => document.getElementById(id);

/** Worker with the library. A request that is made while another one runs waits for it. */
const library = {
  worker: null,
  number: 0,
  waiting: new Map(), // functions that take the answer, by the number of their request

  start() {
    const inline = part("worker-source"); // only in the single file
    const address = inline ? URL.createObjectURL(new Blob([inline.textContent], { type: "text/javascript" })) : "worker.js";
    this.worker = new Worker(address);
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.end("the program of the page cannot be loaded: open the page from a server (python3 -m http.server), or use the " +
        "single file sensor-noise.html");
    };
  },

  take(data) {
    if (data.progress) {
      showProgress(data.progress.pass, data.progress.fraction);
      return;
    }
    const done = this.waiting.get(data.number);
    this.waiting.delete(data.number);
    if (data.answer) {
      done(data.answer);
      return;
    }
    done({
      error: data.unreadable
        ? "a file cannot be read: it was changed, moved or removed after it was chosen. Choose the files again"
        : "the program of the page failed (" + data.failed + "). Leave out the file that was added last, or use the program " +
          "estimate-sensor-noise",
    });
    this.end("the measurement ended with the program that failed. Measure again"); // its memory may be in disorder
  },

  /** Ends the worker, with all requests, which get the sentence as their error. Starts a new worker at the next request. */
  end(sentence) {
    if (this.worker) {
      this.worker.terminate();
      this.worker = null;
    }
    const all = [...this.waiting.values()];
    this.waiting.clear();
    all.forEach((done) => done({ error: sentence }));
  },

  /** Returns the promise of the answer to a request. */
  ask(request, files = []) {
    if (!this.worker) {
      this.start();
    }
    const number = ++this.number;
    return new Promise((resolve) => {
      this.waiting.set(number, resolve);
      this.worker.postMessage({ number: number, request: request, files: files });
    });
  },
};

// ---- files ----

const NO_FRAMES = /(^|\/)(\.[^/]*|thumbs\.db|desktop\.ini)$|\.(json|txt|html?|csv|md|pdf|xml|jpe?g)$/i;
const HEADERS = /\.(mhd|nhdr|cihx?)$/i; // files that name their data files

let frames = []; // objects { name, file }
let dark = [];

/** Returns the files with names that are unique, in the order of their names. */
function named(files, folder = "") {
  const taken = new Set();
  const list = [...files].map((file) => ({ name: file.path || file.webkitRelativePath || file.name, file: file.file || file }));
  list.sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  for (const one of list) {
    let name = folder + one.name.replace(/^\/+/, "");
    for (let number = 2; taken.has(name); ++number) {
      name = folder + number + "-" + one.name.replace(/^\/+/, "");
    }
    taken.add(name);
    one.name = name;
  }
  return list;
}

/** Returns the names of the files that hold frames. */
function frameNames(list) {
  const names = list.map((one) => one.name).filter((name) => !NO_FRAMES.test(name));
  const headers = names.filter((name) => HEADERS.test(name));
  return headers.length > 0 ? headers : names;
}

/** Returns the files in a dropped folder, or the dropped file. */
async function filesOf(entry) {
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
    return [{ path: entry.fullPath, file: file }];
  }
  const reader = entry.createReader();
  const entries = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) {
      break;
    }
    entries.push(...some);
  }
  return (await Promise.all(entries.map(filesOf))).flat();
}

// ---- requests ----

function numberIn(id) {
  return part(id).value === "" ? null : Number(part(id).value);
}

function request(what) {
  const last = frames.length > 0 ? new Date(Math.max(...frames.map((one) => one.file.lastModified))) : new Date();
  const names = frameNames(frames);
  const short = (name) => name.split("/").pop();
  return {
    what: what,
    files: names,
    dark: frameNames(dark),
    method: part("method").value,
    bayer: part("bayer").value,
    bit_depth: numberIn("bit-depth") || 0,
    offset: numberIn("offset"),
    raw: part("raw").value.trim(),
    title: names.length === 1 ? short(names[0]) : names.length > 1 ? short(names[0]) + " to " + short(names.at(-1)) : "",
    date: last.toISOString().slice(0, 16).replace("T", " ") + " UTC",
  };
}

const sentence = (text) => (text === "" ? "" : text[0].toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : "."));

function showError(text) {
  part("error").textContent = sentence(text);
}

let state = 0; // number of the last choice of files and options; older answers are not shown
let measuring = false;
let inspections = 0; // that run or wait

function showStop() {
  part("stop").hidden = !measuring && inspections === 0;
}

async function inspect() {
  const now = ++state;
  part("measure").disabled = true;
  part("note").textContent = "";
  showError("");
  if (frames.length === 0) {
    part("chosen").textContent = "";
    return;
  }
  const count = (list) => list.length + (list.length === 1 ? " file" : " files");
  part("chosen").textContent = count(frameNames(frames)) + (dark.length > 0 ? ", dark frames: " + count(dark) : "") + " …";
  inspections += 1;
  showStop();
  const answer = await library.ask(request("inspect"), [...frames, ...dark]);
  inspections -= 1;
  showStop();
  if (now !== state) {
    return;
  }
  part("chosen").textContent = count(frameNames(frames)) + (dark.length > 0 ? ", dark frames: " + count(dark) : "") +
    (answer.error ? "" : ": " + answer.frames + " frames of " + answer.frame + ", " + answer.size +
      (answer.camera ? ", " + answer.camera : "") + ". The measurement needs at most " + answer.memory + " of memory.");
  if (answer.error) {
    showError(answer.error);
    return;
  }
  part("note").textContent = sentence(answer.warning);
  part("measure").disabled = false;
}

function showProgress(pass, fraction) {
  const passes = Math.max(3, pass + 1); // some stacks are read more often
  part("bar").value = (pass + fraction) / passes;
  part("pass").textContent = "Pass " + (pass + 1) + (pass < 3 ? " of 3" : "");
}

function setWorking(isWorking) {
  measuring = isWorking;
  showStop();
  part("progress").hidden = !isWorking;
  part("measure").disabled = isWorking || frames.length === 0;
  part("example").disabled = isWorking;
  part("bar").value = 0;
  part("pass").textContent = "";
}

let result = null;

async function measure(what, files) {
  showError("");
  part("result").hidden = true;
  setWorking(true);
  const answer = await library.ask(request(what), files);
  setWorking(false);
  if (answer.error) {
    showError(answer.error);
    return;
  }
  result = answer;
  part("export-note").textContent = "";
  part("report").srcdoc = answer.html;
  part("result").hidden = false;
  part("result-title").focus();
}

// ---- results ----

function save(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type: type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

async function saveExport() {
  const answer = await library.ask({ what: "export", report: result.json, format: part("format").value });
  part("export-note").textContent = sentence(answer.error || answer.note);
  (answer.files || []).forEach((file) => save(file.name, file.bytes, "application/octet-stream"));
}

/** Gives the frame of the report the height of its page, also when a section of it is opened. */
function fitReport() {
  const page = part("report").contentDocument;
  const fit = () => { part("report").style.height = page.documentElement.offsetHeight + 40 + "px"; };
  new ResizeObserver(fit).observe(page.documentElement);
  fit();
}

// ---- planner ----

const planned = (id) => (part(id).dataset.power ? 10 ** Number(part(id).value) : Number(part(id).value));

/** Says which least value reaches a goal, rounded up to three digits; null: none up to the largest one does. */
function enough(what, least, most, unit) {
  if (least === null) {
    return "no " + what + " up to " + most.toLocaleString("en") + unit + " is enough";
  }
  const step = 10 ** (Math.floor(Math.log10(least)) - 2);
  return "a " + what + " of " + Number((Math.ceil(least / step) * step).toPrecision(3)) + unit + " is enough";
}

async function plan() {
  const values = {};
  for (const slider of part("plan").querySelectorAll("input")) {
    const text = planned(slider.id).toFixed(Number(slider.dataset.digits));
    part(slider.id + "-value").textContent = text;
    slider.setAttribute("aria-valuetext", text);
    values[slider.id.replace("-", "_")] = planned(slider.id);
  }
  values.frames = Math.round(values.frames);
  values.flicker /= 100;
  const answer = await library.ask({ what: "plan", ...values });
  if (answer.error) {
    part("planned").textContent = sentence(answer.error);
    return;
  }
  const number = (value) => (value === null ? "" : value.toPrecision(2).includes("e") ? Number(value.toPrecision(2)).toLocaleString("en") : value.toPrecision(2));
  const frames = (count) => Math.max(2, count).toLocaleString("en") + " frames";
  const gainFrames = "± 1 % needs " + frames(answer.frames_for_gain) + "; with " + frames(values.frames) + " ";
  const contrast = (least) => enough("contrast", least, answer.most_contrast, "");
  const percent = (part) => (part === null ? null : 100 * part);
  const flicker = enough("flicker", percent(answer.flicker_for_offset), percent(answer.most_flicker), " %");
  const offset = answer.offset_dn === null
    ? "The offset is not identifiable without flicker: record dark frames. For ± 1 DN with " + frames(values.frames) + ", " + flicker
    : "Offset: ± " + number(answer.offset_dn) + " DN; ± 1 DN needs " + frames(answer.frames_for_offset) + "; with " +
      frames(values.frames) + " " + contrast(answer.contrast_for_offset) + ", or " + flicker;
  part("planned").textContent = "Gain: ± " + number(answer.gain_percent) + " %; " + gainFrames +
    contrast(answer.contrast_for_gain) + ". " + offset + ". Record at least 20 frames.";
}

// ---- events ----

function take(files) {
  frames = named(files);
  inspect();
}

for (const id of ["files", "folder"]) {
  part(id).addEventListener("change", () => {
    take(part(id).files);
    part(id).value = ""; // a browser announces the same files again only if none are chosen
    part(id).blur();
  });
}
part("dark").addEventListener("change", () => { dark = named(part("dark").files, "dark/"); inspect(); });
for (const id of ["method", "bayer", "bit-depth", "offset", "raw"]) {
  part(id).addEventListener("change", inspect);
}
document.addEventListener("dragover", (event) => { event.preventDefault(); part("drop").classList.add("over"); });
document.addEventListener("dragleave", () => part("drop").classList.remove("over"));
document.addEventListener("drop", async (event) => {
  event.preventDefault();
  part("drop").classList.remove("over");
  const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry());
  const dropped = [...event.dataTransfer.files];
  take(entries.length > 0 && entries.every(Boolean) ? (await Promise.all(entries.map(filesOf))).flat() : dropped);
});
part("form").addEventListener("submit", (event) => { event.preventDefault(); measure("estimate", [...frames, ...dark]); });
part("example").addEventListener("click", () => measure("example", []));
part("stop").addEventListener("click", () => library.end(measuring
  ? "the measurement was stopped"
  : "the check of the files was stopped. Choose the files again"));
part("save-page").addEventListener("click", () => save("report.html", result.html, "text/html"));
part("save-json").addEventListener("click", () => save("report.json", result.json, "application/json"));
part("save-export").addEventListener("click", saveExport);
part("report").addEventListener("load", fitReport);
part("plan").addEventListener("input", plan);

library.ask({ what: "formats" }).then((answer) => {
  part("version").textContent = answer.version || "";
  for (const format of answer.formats || []) {
    part("format").add(new Option(format.consumer, format.name));
  }
  if (answer.error) {
    showError(answer.error);
  }
});
plan();
