'use strict';
// Elements and numbers of the page. Texts become text nodes and nothing else, so that no name of a recipe can become
// markup.

// element('p', {class: 'lead'}, 'text', child, ...); null children are left out.
function element(name, attributes, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes || {})) {
        if (key === 'onclick') {
            made.addEventListener('click', value);
        } else if (value !== null && value !== undefined) {
            made.setAttribute(key, value);
        }
    }
    made.append(...children.filter((child) => child !== null && child !== undefined));
    return made;
}

// Two significant digits: 0.0036, 7.1e-6, 12.
function figure(value) {
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (size < 1e-3 || size >= 1e5) return value.toExponential(1).replace('e+', 'e');
    return String(Number(value.toPrecision(2)));
}
// Four: values of a table or a parameter.
function number(value) {
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-4 || size >= 1e6)) {
        return String(value.toExponential(3)).replace(/\.?0+e/, 'e').replace('e+', 'e');
    }
    return String(Number(value.toPrecision(4)));
}
function duration(seconds) {
    if (seconds < 1e-3) return `${figure(seconds * 1e6)} µs`;
    if (seconds < 1) return `${figure(seconds * 1e3)} ms`;
    return `${seconds < 60 ? figure(seconds) : Math.round(seconds)} s`;
}
function byteCount(bytes) {
    if (bytes < 1024) return `${bytes} B`;
    if (bytes < 1048576) return `${number(Number((bytes / 1024).toPrecision(3)))} KiB`;
    return `${number(Number((bytes / 1048576).toPrecision(3)))} MiB`;
}
