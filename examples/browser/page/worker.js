// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Answers the requests of the page, one after the other, by the library that is compiled to WebAssembly. The page stays
// alive meanwhile, and ends the worker to stop it.
"use strict";

if (typeof makeSensorNoise === "undefined") {
  importScripts("sensor-noise.js"); // in the single file it stands before this text
}

const settings = { onProgress: (pass, fraction) => postMessage({ progress: { pass: pass, fraction: fraction } }) };
if (typeof SENSOR_NOISE_WASM !== "undefined") {
  settings.wasmBinary = Uint8Array.from(atob(SENSOR_NOISE_WASM), (letter) => letter.charCodeAt(0));
}
const library = makeSensorNoise(settings);
let folders = 0;

/** Makes the files of a request readable below a new folder, which becomes the current one. */
function mountFiles(module, files) {
  const folder = "/burst" + ++folders;
  module.FS.mkdir(folder);
  module.FS.mount(module.WORKERFS, { blobs: files.map(({ name, file }) => ({ name: name, data: file })) }, folder);
  module.FS.chdir(folder);
  return folder;
}

/** Returns the answer to a request, with the bytes of the files that it wrote. */
function answerOf(module, request, files) {
  const mounted = files.length > 0 ? mountFiles(module, files) : null;
  const out = "/out" + ++folders;
  module.FS.mkdir(out);
  try {
    const text = JSON.stringify({ ...request, folder: out });
    const answer = JSON.parse(module.ccall("AnswerPage", "string", ["string"], [text]));
    if (request.what === "export" && answer.files) {
      answer.files = answer.files.map((name) => ({ name: name, bytes: module.FS.readFile(out + "/" + name) }));
    }
    return answer;
  } finally {
    module.FS.chdir("/");
    if (mounted) {
      module.FS.unmount(mounted);
    }
  }
}

onmessage = async ({ data }) => {
  try {
    postMessage({ number: data.number, answer: answerOf(await library, data.request, data.files) });
  } catch (error) {
    const isUnreadable = error && ["NotReadableError", "NotFoundError", "SecurityError"].includes(error.name);
    const sentence = String((error && error.message) || error);
    postMessage({ number: data.number, [isUnreadable ? "unreadable" : "failed"]: sentence });
  }
};
