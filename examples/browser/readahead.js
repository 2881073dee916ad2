// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// The C++ library reads 4 KiB at a time, and each part of a file costs the browser as long as megabytes: the last part that
// was read is kept.
const READ_AHEAD_BYTES = 4 * 1024 * 1024;
let part = { file: null, begin: 0, bytes: new Uint8Array(0) };

WORKERFS.stream_ops.read = (stream, buffer, offset, length, position) => {
  const file = stream.node.contents;
  const end = Math.min(position + length, file.size);
  let done = 0;
  while (position + done < end) {
    const at = position + done;
    if (part.file !== file || at < part.begin || at >= part.begin + part.bytes.length) {
      const bytes = new FileReaderSync().readAsArrayBuffer(file.slice(at, at + READ_AHEAD_BYTES));
      part = { file: file, begin: at, bytes: new Uint8Array(bytes) };
      if (part.bytes.length === 0) {
        break; // the file became shorter
      }
    }
    const from = at - part.begin;
    const some = part.bytes.subarray(from, Math.min(part.bytes.length, from + end - at));
    buffer.set(some, offset + done);
    done += some.length;
  }
  return done;
};

Module["WORKERFS"] = WORKERFS; // for worker.js, which mounts files
