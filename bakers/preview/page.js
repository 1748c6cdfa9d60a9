'use strict';
// Arranges the page of the data that stand in it, and arranges it anew where a watching page gets others.

// The parts to be looked at come first: tables of variants, all clouds in one sky, clouds in their light, the
// sky, then all others.
function sectionsOf(preview) {
    const isLit = (asset) => asset.pictures.some((picture) => picture.kind === 'scene');
    const named = (asset) => [asset.name, () => assetSection(asset)];
    const titled = (scene) => [scene.title, () => sceneSection(scene)];
    return [
        ...preview.tables.map((table) => [table.title, () => tableSection(table)]),
        ...preview.scenes.filter((scene) => scene.clouds).map(titled),
        ...preview.assets.filter(isLit).map(named),
        ...preview.scenes.filter((scene) => !scene.clouds).map(titled),
        ...preview.assets.filter((asset) => !isLit(asset)).map(named),
    ];
}

// The first picture stands above all words but the page's name. The images are those within `standing`.
function pageOf(preview, standing, diagnostics) {
    takeImages(standing);
    const sections = sectionsOf(preview);
    const [first, ...others] = sections.map(([, made]) => made());
    return element('main', {},
        element('header', {}, element('h1', {}, preview.title), diagnostics),
        first,
        notice(preview.notes),
        sections.length > 1 ? element('nav', {'aria-label': 'Sections'}, ...sections.map(
            ([title]) => element('a', {href: `#${anchor(title)}`}, title))) : null,
        ...others,
        preview.assets.length > 0 ? overview(preview) : null,
        element('footer', {}, element('p', {class: 'overline'}, preview.generator)));
}

const standingPictures = document.getElementById('pictures');
let main = pageOf(JSON.parse(document.getElementById('preview').textContent), standingPictures,
    element('div', {id: 'diagnostics', 'aria-live': 'polite'}));
document.body.append(main, dialog);
standingPictures.remove();

// --- Other pictures in place of these -----------------------------------------------------------

const controls = 'a, button, input, summary, [tabindex]';
const sectionId = (part) => part.closest('section')?.id ?? '';
// Tells details apart by their words, and their number among those of the section with the same words.
function placeOf(whole, details) {
    const words = details.firstChild.textContent;
    const alike = Array.from(whole.querySelectorAll('details')).filter((other) =>
        sectionId(other) === sectionId(details) && other.firstChild.textContent === words);
    return `${words} ${alike.indexOf(details)}`;
}

// Returns a reader's choices: open details, tabs, the turn of a turntable, and where the focus is.
function choicesIn(whole) {
    const all = (selector) => Array.from(whole.querySelectorAll(selector));
    const of = (part) => all(controls).filter((other) => sectionId(other) === sectionId(part));
    const focused = whole.contains(document.activeElement) ? document.activeElement : null;
    return {
        open: all('details[open]').map((part) => [sectionId(part), placeOf(whole, part)]),
        tabs: all('[role=tab][aria-selected=true]').map((tab) => [sectionId(tab), tab.textContent]),
        turns: all('input[type=range]').map((slider) => [sectionId(slider), slider.value]),
        focus: focused && [sectionId(focused), of(focused).indexOf(focused),
                           focused.matches('summary') ? placeOf(whole, focused.parentElement) : null],
    };
}
function choose(whole, {open, tabs, turns, focus}) {
    const among = (chosen, part, value) => chosen.some(([id, other]) => id === sectionId(part) && other === value);
    for (const tab of whole.querySelectorAll('[role=tab]')) if (among(tabs, tab, tab.textContent)) tab.click();
    for (const part of whole.querySelectorAll('details')) part.open = among(open, part, placeOf(whole, part));
    for (const slider of whole.querySelectorAll('input[type=range]')) {
        const turn = turns.find(([id]) => id === sectionId(slider));
        if (!turn) continue;
        slider.value = turn[1];
        slider.dispatchEvent(new Event('input'));
    }
    if (!focus) return;
    const [section, index, place] = focus;
    const found = Array.from(whole.querySelectorAll(controls)).filter((part) => sectionId(part) === section);
    const folded = found.find((part) => place && part.matches('summary') && placeOf(whole, part.parentElement) === place);
    (folded ?? found[index])?.focus({preventScroll: true});
}

// Shows other data with the figures of `html`, once their images can be painted. What the reader looks at stays.
window.skybakeReplace = async (preview, html) => {
    const standing = element('main');
    standing.innerHTML = html;
    await Promise.all(Array.from(standing.querySelectorAll('img'), (image) => image.decode().catch(() => null)));
    const choices = choicesIn(main), at = scrollY;
    const before = main;
    main = pageOf(preview, standing, document.getElementById('diagnostics'));
    before.replaceWith(main);
    choose(main, choices);
    scrollTo({top: at, behavior: 'instant'});
    const again = dialog.open ? shown.findIndex((picture) => picture.name === dialog.dataset.name) : -1;
    if (again >= 0) enlarge(again);
    else dialog.close();
};
