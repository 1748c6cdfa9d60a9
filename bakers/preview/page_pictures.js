'use strict';
// The pictures of the page: figures, tabs of them, and those that turn.

// The images stand in an element already, for browsers without scripts; each moves to its place.
let standing = null;
let images = new Map();
let shown = [];  // every picture of the page, in its order
function takeImages(from) {
    standing = from;
    images = new Map(Array.from(from.querySelectorAll('img'), (image) => [image.dataset.file, image]));
    shown = [];
}
function pictureButton(picture) {
    const index = shown.push(picture) - 1;
    return element('button', {type: 'button', class: 'picture', 'aria-label': `Enlarge: ${picture.title}`,
                              onclick: () => enlarge(index)}, imageOf(picture));
}
function imageOf(picture) {
    const image = images.get(picture.file);
    return image.isConnected && !standing.contains(image) ? image.cloneNode() : image;
}
// A title that stands in the picture does not stand below it too. A caption's second line is folded. Where the
// picture changes, `words` stand in the place of its first line.
function figureOf(picture, content, words = null) {
    const [caption, more] = picture.caption.split('\n');
    return element('figure',
        {style: `--shape: ${(picture.width / picture.height).toFixed(3)}; --width: ${picture.width}px`, 'data-name': picture.name,
         class: picture.kind},
        ...content, element('figcaption', {},
            picture.titled ? null : element('b', {}, picture.title), words ?? caption,
            more ? element('details', {}, element('summary', {}, 'How it was made'), more) : null));
}
// Pictures of one sequence are a turntable, those of one group are tabs of one figure, and every
// other picture is a figure of its own.
function gallery(pictures) {
    if (pictures.length === 0) return null;
    const alike = (picture, key) => pictures.filter((other) => other[key] === picture[key]);
    return element('div', {class: 'gallery'}, ...pictures.map((picture) => {
        const key = picture.sequence !== '' ? 'sequence' : 'group';
        const all = picture[key] === '' ? [picture] : alike(picture, key);
        if (all[0] !== picture) return null;
        if (key === 'sequence') return turntable(all);
        return all.length === 1 ? figureOf(picture, [pictureButton(picture)]) : tabbedFigures(all);
    }));
}
function tabbedFigures(pictures) {
    const choices = pictures.map((picture) => ({
        title: picture.tab, content: figureOf(picture, [pictureButton(picture)])}));
    const whole = tabbed(pictures[0].title, choices);
    const shape = Math.max(...pictures.map((picture) => picture.width / picture.height));
    whole.style.setProperty('--shape', shape.toFixed(3));
    whole.style.setProperty('--width', `${Math.max(...pictures.map((picture) => picture.width))}px`);
    whole.classList.add(pictures[0].kind);
    return whole;
}

// One picture that turns, or frames that play: by a slider, by dragging, by the arrow keys, or by itself. Frames
// begin to play at once where readers have not asked their system for less motion.
function turntable(frames) {
    const image = imageOf(frames[0]);
    const sources = frames.map((frame) => images.get(frame.file).getAttribute('src'));
    sources.forEach((source) => { new Image().src = source; });
    const perSecond = frames[0].frames_per_second;
    const slider = element('input', {type: 'range', min: 0, max: frames.length - 1, value: 0,
                                     'aria-label': `${perSecond > 0 ? 'Frame' : 'Turn'}: ${frames[0].title}`});
    const words = element('span');
    let timer = null;
    function show(index) {
        const at = (Math.round(index) % frames.length + frames.length) % frames.length;
        slider.value = at;
        image.src = sources[at];
        image.alt = frames[at].caption;
        words.textContent = frames[at].caption.split('\n')[0];
    }
    function step() {
        if (figure.isConnected) show(Number(slider.value) + 1);
        else play();
    }
    function play() {
        if (timer !== null) clearInterval(timer);
        timer = timer === null ? setInterval(step, 1000 / (perSecond || 12)) : null;
        button.textContent = timer === null ? 'Play' : 'Stop';
    }
    const button = element('button', {type: 'button', onclick: play}, 'Play');
    slider.addEventListener('input', () => show(slider.value));
    // Whoever takes hold of it stops it.
    const stop = () => { if (timer !== null) play(); };
    slider.addEventListener('pointerdown', stop);
    slider.addEventListener('keydown', (event) => { if (event.key !== 'Tab') stop(); });
    // A drag across the whole picture turns it once.
    let held = null;
    image.draggable = false;
    image.addEventListener('pointerdown', (event) => {
        stop();
        held = {x: event.clientX, index: Number(slider.value)};
        image.setPointerCapture(event.pointerId);
    });
    image.addEventListener('pointermove', (event) => {
        if (held) show(held.index + (event.clientX - held.x) / image.clientWidth * frames.length);
    });
    for (const end of ['pointerup', 'pointercancel']) image.addEventListener(end, () => { held = null; });
    const figure = figureOf(frames[0], [image, element('div', {class: 'turn'}, button, slider)], words);
    figure.classList.add('turntable');
    show(0);
    if (perSecond > 0 && !matchMedia('(prefers-reduced-motion: reduce)').matches) play();
    return figure;
}
