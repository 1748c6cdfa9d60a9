'use strict';
// The enlarged picture.

// A modal dialog: the browser keeps the focus within, closes it by Esc, and gives the focus back.
const large = {
    count: element('span', {class: 'count', 'aria-live': 'polite'}),
    file: element('a', {}, 'Save'),
    stage: element('div', {class: 'stage', onclick: () => dialog.close()}),
    words: element('p'),
};
const dialog = element('dialog', {'aria-label': 'Enlarged picture'},
    element('div', {class: 'bar'}, large.count, large.file,
        element('button', {type: 'button', 'aria-label': 'Previous picture', onclick: () => step(-1)}, '←'),
        element('button', {type: 'button', 'aria-label': 'Next picture', onclick: () => step(1)}, '→'),
        element('button', {type: 'button', 'aria-label': 'Close', autofocus: '', onclick: () => dialog.close()}, '✕')),
    large.stage, large.words);
let enlarged = 0;
function enlarge(index) {
    enlarged = index;
    const picture = shown[index];
    large.count.textContent = `${index + 1} of ${shown.length}`;
    large.file.href = images.get(picture.file).src;
    large.file.download = picture.file;
    dialog.dataset.name = picture.name;
    const image = imageOf(picture);
    const scale = picture.width < 600 ? 2 : 1;
    image.width = picture.width * scale;
    image.height = picture.height * scale;
    large.stage.replaceChildren(image);
    large.words.replaceChildren(element('b', {}, picture.title), picture.caption ? ` ${picture.caption}` : '');
    if (!dialog.open) dialog.showModal();
}
function step(by) {
    enlarge((enlarged + by + shown.length) % shown.length);
}
dialog.addEventListener('keydown', (event) => {
    if (event.key === 'ArrowLeft') step(-1);
    if (event.key === 'ArrowRight') step(1);
});
