'use strict';
// Builds the page's sections on assets, scenes and sweeps.

const extent = (asset) => asset.size.join(' × ');
const totalBytes = (asset) => asset.files.length === 0
    ? null : asset.files.reduce((sum, entry) => sum + entry.bytes, 0);

function anchor(title) {
    return `s-${encodeURIComponent(title)}`;
}

function skyFigure(asset, name) {
    const sky = asset.error?.sky;
    return amount(sky && sky.points > 0 ? sky[name] : null, percent);
}
function percent(share) {
    return `${figure(100 * share)} %`;
}

function overview(preview) {
    // A preview of a recipe writes no files.
    const anyFile = preview.assets.some((asset) => totalBytes(asset) !== null);
    const columns = [{title: 'Asset'}, {title: 'Kind'}, {title: 'Size'}, {title: 'Channels'},
        {title: 'Sky error, median', number: true}, {title: 'max', number: true},
        {title: 'Lookup error, max', number: true}, {title: 'RMS', number: true},
        {title: 'Bake', number: true}, ...(anyFile ? [{title: 'Files', number: true}] : [])];
    const rows = preview.assets.map((asset) => [
        {text: asset.name, value: asset.name, wraps: true,
         content: element('a', {href: `#${anchor(asset.name)}`}, asset.name)},
        text(asset.kind.replaceAll('_', ' ')),
        {text: extent(asset), value: asset.size.reduce((product, edge) => product * edge, 1)},
        text(asset.channels.join(' ')),
        skyFigure(asset, 'median'),
        skyFigure(asset, 'max'),
        amount(asset.error && asset.error.lookup.max, figure),
        amount(asset.error && asset.error.lookup.rms, figure),
        amount(asset.bake_s || null, duration),
        ...(anyFile ? [amount(totalBytes(asset), byteCount)] : []),
    ]);
    return element('section', {}, element('h2', {}, 'All assets'), sortableTable(columns, rows, 'All assets'));
}

function fact(title, value, ...more) {
    return element('div', {}, element('dt', {}, title),
        element('dd', {}, value, ...more.filter(Boolean).map((line) => element('small', {}, line))));
}
function facts(asset) {
    const error = asset.error;
    const sky = error?.sky;
    const type = asset.files.length > 0 ? asset.files[0].pixel_type : asset.pixel_type;
    return element('dl', {class: 'facts'},
        sky && sky.points === 0 ? fact('Sky error', 'too noisy to tell', `against ${sky.reference}`) : null,
        sky && sky.points > 0 ? fact('Sky error, median / 9 in 10 / max',
            `${percent(sky.median)} / ${percent(sky.ninth_decile)} / ${percent(sky.max)}`,
            `against ${sky.reference}, standard error ${percent(sky.standard_error)}`,
            `largest at ${sky.worst}`) : null,
        fact('Size', extent(asset), [asset.channels.join(' '), type].filter(Boolean).join(', ')),
        error ? fact('Lookup error, max / RMS', `${figure(error.lookup.max)} / ${figure(error.lookup.rms)}`,
            `${error.points} points; ${error.scale}`) : fact('Lookup error', 'not measured'),
        error ? fact('Texel error, max / RMS', `${figure(error.texel.max)} / ${figure(error.texel.rms)}`,
            `${error.texel_points} texels`) : null,
        error ? fact('Reference', '', error.reference) : null,
        asset.bake_s > 0 ? fact('Bake time', duration(asset.bake_s),
            asset.threads === 1 ? 'one thread' : `${asset.threads} threads`) : null,
        totalBytes(asset) === null ? null : fact('Files', byteCount(totalBytes(asset)),
            asset.files.map((entry) => entry.path).join(', ')),
        fact('Mapping', asset.mapping, asset.axes.map((axis) => axis.quantity).join(', ')),
        asset.seam_error === undefined ? null : fact('Seam', figure(asset.seam_error),
            'largest difference across a border'));
}
function folded(title, content) {
    return element('details', {}, element('summary', {}, title), content);
}
function axisTable(asset) {
    const letters = ['u', 'v', 'w'];
    return sortableTable(
        [{title: 'Axis'}, {title: 'Quantity'}, {title: 'From', number: true}, {title: 'To', number: true},
         {title: 'Formula'}, {title: 'Convention'}],
        asset.axes.map((axis, i) => [text(letters[i]), text(axis.quantity), amount(axis.first, number),
            amount(axis.last, number), text(axis.formula, true), text(axis.convention, true)]),
        `Axes of ${asset.name}`);
}
function channelTable(asset) {
    return sortableTable(
        [{title: 'Channel'}, {title: 'Minimum', number: true}, {title: 'Mean', number: true},
         {title: 'Maximum', number: true}],
        asset.statistics.map((channel, i) => [text(asset.channels[i]), amount(channel.min, number),
            amount(channel.mean, number), amount(channel.max, number)]),
        `Values of ${asset.name}`);
}
function code(value) {
    return {text: value, value, content: element('span', {class: 'code'}, value)};
}
function fileTable(asset) {
    return sortableTable(
        [{title: 'File'}, {title: 'Format'}, {title: 'Pixels'}, {title: 'Bytes', number: true}, {title: 'XXH3 of the file'}],
        asset.files.map((entry) => [text(entry.path, true), text(entry.format), text(entry.pixel_type),
            amount(entry.bytes, (bytes) => bytes.toLocaleString('en')), code(entry.xxh3)]),
        `Files of ${asset.name}`);
}
function detailTable(asset) {
    return sortableTable([{title: 'Fact'}, {title: 'Value'}],
        asset.details.concat([['hash of the content', asset.content_hash]]).map(
            ([key, value]) => [text(key.replaceAll('_', ' ')), text(value, true)]),
        `Further facts of ${asset.name}`);
}
function assetSection(asset) {
    return element('section', {id: anchor(asset.name)},
        element('h2', {}, asset.name),
        gallery(asset.pictures),
        element('p', {class: 'lead'}, asset.content),
        facts(asset),
        asset.error && asset.error.worst ? element('p', {class: 'advice'},
            `The largest lookup error is at ${asset.error.worst}${asset.error.advice ? '; ' + asset.error.advice : ''}.`) : null,
        element('div', {class: 'more'},
            asset.statistics.length > 0 ? folded('Values', channelTable(asset)) : null,
            folded('Mapping', axisTable(asset)),
            asset.files.length > 0 ? folded('Files and hashes', fileTable(asset)) : null,
            folded('Details', detailTable(asset)),
            asset.parameters ? folded('Parameters', element('pre', {tabindex: '0'}, asset.parameters)) : null));
}
function sceneSection(scene) {
    return element('section', {id: anchor(scene.title)}, element('h2', {}, scene.title),
        gallery(scene.pictures), scene.content ? element('p', {class: 'lead'}, scene.content) : null);
}
// A variant by its number, which its name begins with, with a link to its folder, if it has one.
function folderLink(row) {
    if (row.folder === '') return {text: row.name, value: row.name};
    const href = row.folder.split('/').map(encodeURIComponent).join('/');
    return {text: row.name, value: row.name,
            content: element('a', {href, title: row.name}, row.name.split('_')[0])};
}
function tableSection(table) {
    const shown = {number, figure, percent, byteCount, duration};
    const columns = [{title: ''}, {title: 'Variant'}, ...table.columns.map(
        ({title, shown: name}) => ({title, number: name !== '', wraps: name !== ''}))];
    const rows = table.rows.map((row) => [
        {text: '', value: null, content: row.picture ? pictureButton(row.picture) : ''},
        folderLink(row),
        ...row.cells.map((cell, i) => cell.text !== null ? cell
            : amount(cell.value, shown[table.columns[i].shown])),
    ]);
    return element('section', {id: anchor(table.title)}, element('h2', {}, table.title),
        element('p', {class: 'lead'}, table.content), gallery(table.pictures),
        sortableTable(columns, rows, `Variants of ${table.title}`));
}

function notice(notes) {
    if (notes.length === 0) return null;
    return element('div', {class: 'notice'}, notes.length === 1 ? notes[0]
        : element('ul', {}, ...notes.map((note) => element('li', {}, note))));
}
