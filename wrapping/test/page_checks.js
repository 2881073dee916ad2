// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// What is wrong with the page that is shown, a sentence each. For test_browser.py, which runs it in Chromium.
(() => {
  const faults = [];
  const words = (text) => '"' + text.trim().replace(/\s+/g, " ").slice(0, 50) + '"';
  document.querySelectorAll("details").forEach((part) => (part.open = true));

  // Pieces of text as they are drawn: a rectangle for each line.
  const pieces = [];
  const walker = document.createTreeWalker(document.documentElement, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode;
    const owner = node.parentElement;
    if (!node.data.trim() || ["SCRIPT", "STYLE", "TITLE", "style", "title"].includes(owner.tagName)) continue;
    if (owner.closest("[hidden], select")) continue; // a browser draws the choices of a list itself
    const range = document.createRange();
    range.selectNodeContents(node);
    const lines = [...range.getClientRects()].filter((line) => line.width > 0 && line.height > 0);
    pieces.push({ node, owner, lines, inSvg: owner.namespaceURI.endsWith("svg") });
  }
  if (!pieces.length) faults.push("no text is shown");
  for (const { node } of pieces) {
    if (/\b(nan|inf|null|undefined)\b/.test(node.data)) faults.push(`is no number: ${words(node.data)}`);
  }

  // 1: nothing is wider than the window. An SVG file is as large as it says.
  const page = document.scrollingElement;
  if (page && page.namespaceURI.endsWith("xhtml")) {
    if (page.scrollWidth > page.clientWidth) faults.push(`scrolls sideways: ${page.scrollWidth} px of ${page.clientWidth}`);
  }

  // 2: text is read: 4.5 is what WCAG 2.1 asks for at level AA (1.4.3).
  const colour = (text) => {
    const parts = text.match(/[\d.]+/g).map(Number);
    return { rgb: parts.slice(0, 3), alpha: parts.length > 3 ? parts[3] : 1 };
  };
  const luminance = (rgb) => {
    const linear = rgb.map((c) => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const contrast = (one, other) => {
    const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const behind = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const found = colour(getComputedStyle(at).backgroundColor);
      if (found.alpha === 1) return found.rgb;
    }
    const paper = document.querySelector("rect.paper"); // of an SVG file
    return paper ? colour(getComputedStyle(paper).fill).rgb : [255, 255, 255];
  };
  for (const { node, owner, inSvg } of pieces) {
    const style = getComputedStyle(owner);
    const ratio = contrast(colour(inSvg ? style.fill : style.color).rgb, behind(owner));
    if (ratio < 4.5) faults.push(`contrast ${ratio.toFixed(2)}: ${words(node.data)}`);
    if (parseFloat(style.fontSize) < 11 && !inSvg) faults.push(`letters of ${style.fontSize}: ${words(node.data)}`);
  }

  // 3: text lies inside the box that it belongs to, a pixel of rounding aside.
  const inside = (line, box) =>
    line.left >= box.left - 1 && line.right <= box.right + 1 && line.top >= box.top - 1 && line.bottom <= box.bottom + 1;
  const boxes = "li, td, th, dt, dd, p, figcaption, summary, h1, h2, h3, label, button";
  for (const { node, owner, lines, inSvg } of pieces) {
    let box = inSvg ? owner.ownerSVGElement : owner.closest(boxes);
    while (box && getComputedStyle(box).display === "contents") box = box.parentElement;
    while (inSvg && box.ownerSVGElement) box = box.ownerSVGElement;
    if (!box) {
      faults.push(`text outside of every box: ${words(node.data)}`);
    } else if (!lines.length || !lines.every((line) => inside(line, box.getBoundingClientRect()))) {
      faults.push(`is cut off by its ${box.tagName}: ${words(node.data)}`);
    }
  }

  // 4: no text lies on other text or, in a figure, on a panel with its points, unless it stands instead of one.
  const shrunk = (box) => ({ left: box.left + 1, right: box.right - 1, top: box.top + 2, bottom: box.bottom - 2 });
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  const drawn = pieces.flatMap(({ node, lines }) => lines.map((line) => ({ node, box: shrunk(line) })));
  drawn.sort((a, b) => a.box.top - b.box.top);
  for (let i = 0; i < drawn.length; ++i) {
    for (let j = i + 1; j < drawn.length && drawn[j].box.top < drawn[i].box.bottom; ++j) {
      if (drawn[i].node !== drawn[j].node && meet(drawn[i].box, drawn[j].box)) {
        faults.push(`${words(drawn[i].node.data)} and ${words(drawn[j].node.data)} lie on each other`);
      }
    }
  }
  for (const panel of document.querySelectorAll("svg svg")) {
    const [x, y, width, height] = ["x", "y", "width", "height"].map((name) => panel[name].baseVal.value);
    const matrix = panel.parentElement.getScreenCTM();
    const box = { left: x * matrix.a + matrix.e, top: y * matrix.d + matrix.f };
    box.right = box.left + width * matrix.a;
    box.bottom = box.top + height * matrix.d;
    for (const { node, box: text } of drawn) {
      const isInstead = node.parentElement.classList.contains("instead");
      if (meet(text, box) && !isInstead) faults.push(`${words(node.data)} lies on the points of a figure`);
    }
  }

  // 5: pictures are there.
  for (const image of document.images) {
    if (!image.complete || !image.naturalWidth) faults.push(`no picture: ${image.alt}`);
    if (!image.alt) faults.push("a picture without words");
  }

  // 6: who does not see the page finds their way.
  const ids = [...document.querySelectorAll("[id]")].map((part) => part.id);
  ids.filter((id, i) => ids.indexOf(id) < i).forEach((id) => faults.push(`is there twice: #${id}`));
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    if (!ids.includes(link.hash.slice(1))) faults.push(`leads nowhere: ${link.hash}`);
  }
  let level = 0;
  for (const heading of document.querySelectorAll("h1, h2, h3, h4")) {
    if (heading.tagName[1] > level + 1) faults.push(`skips a level: ${words(heading.innerText)}`);
    level = +heading.tagName[1];
  }
  for (const figure of document.querySelectorAll("svg[role=img]")) {
    if (!figure.getAttribute("aria-label")) faults.push("a figure without a name");
  }
  for (const head of document.querySelectorAll("th")) {
    if (!head.scope) faults.push(`a head of a table without a scope: ${words(head.innerText)}`);
  }
  return faults;
})();
