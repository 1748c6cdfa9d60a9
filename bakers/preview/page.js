'use strict';
// Builds the page of the data that stand in it. Texts become text nodes and nothing else, so that no
// name of a recipe can become markup.
(() => {
    const preview = JSON.parse(document.getElementById('preview').textContent);

    // --- Elements -------------------------------------------------------------------------------

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

    // --- Numbers --------------------------------------------------------------------------------

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

    // --- Sortable tables ------------------------------------------------------------------------

    // columns: {title, number}; rows: arrays of cells {text, value, content, wraps}. A cell sorts by
    // its value (numbers, then texts, then what has none), shows its content or its text.
    function sortableTable(columns, rows, label) {
        const body = element('tbody');
        const heads = [];
        const lines = rows.map((cells) => {
            const line = element('tr', {}, ...cells.map((cell, i) => element('td', {
                class: [columns[i].number ? 'number' : '', cell.wraps ? 'wraps' : ''].join(' ').trim() || null,
            }, cell.content || cell.text)));
            return {cells, line};
        });
        body.append(...lines.map((row) => row.line));
        function sortBy(column) {
            const ascending = heads[column].getAttribute('aria-sort') !== 'ascending';
            heads.forEach((head, i) => head.setAttribute(
                'aria-sort', i !== column ? 'none' : ascending ? 'ascending' : 'descending'));
            const sorted = lines.slice().sort((a, b) => compare(a.cells[column], b.cells[column], ascending));
            body.append(...sorted.map((row) => row.line));
        }
        columns.forEach((column, i) => {
            const plain = column.title === '' || rows.length < 2;
            heads.push(element('th', {scope: 'col', class: column.number ? 'number' : null,
                                      'aria-sort': plain ? null : 'none'},
                plain ? column.title
                      : element('button', {type: 'button', onclick: () => sortBy(i)}, column.title)));
        });
        return element('div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': label},
            element('table', {}, element('thead', {}, element('tr', {}, ...heads)), body));
    }
    // Missing values are last whichever way the table is sorted.
    function compare(a, b, ascending) {
        const missing = (cell) => cell.value === null || cell.value === undefined;
        if (missing(a) || missing(b)) return missing(a) - missing(b);
        const both = typeof a.value === 'number' && typeof b.value === 'number';
        const order = both ? a.value - b.value
                           : String(a.value).localeCompare(String(b.value), 'en', {numeric: true});
        return ascending ? order : -order;
    }
    const text = (value, wraps) => ({text: value, value, wraps});
    const amount = (value, shown) => value === null || value === undefined
        ? {text: '–', value: null} : {text: shown(value), value};

    // --- Pictures -------------------------------------------------------------------------------

    // The images stand in the page already, for browsers without scripts; each moves to its place.
    const standing = document.getElementById('pictures');
    const images = new Map(Array.from(standing.querySelectorAll('img'), (image) => [image.dataset.file, image]));
    const shown = [];  // every picture of the page, in its order
    function pictureButton(picture) {
        const index = shown.push(picture) - 1;
        return element('button', {type: 'button', class: 'picture', 'aria-label': `Enlarge: ${picture.title}`,
                                  onclick: () => enlarge(index)}, imageOf(picture));
    }
    function imageOf(picture) {
        const image = images.get(picture.file);
        return image.isConnected && !standing.contains(image) ? image.cloneNode() : image;
    }
    // A title that stands in the picture does not stand below it too.
    function figureOf(picture, content) {
        return element('figure',
            {style: `--shape: ${(picture.width / picture.height).toFixed(3)}`, 'data-name': picture.name,
             class: picture.kind},
            ...content, element('figcaption', {},
                picture.titled ? null : element('b', {}, picture.title), picture.caption));
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
        whole.classList.add(pictures[0].kind);
        return whole;
    }

    // One picture that turns: by its slider, by dragging, by the arrow keys, or by itself.
    function turntable(frames) {
        const image = imageOf(frames[0]);
        const sources = frames.map((frame) => images.get(frame.file).getAttribute('src'));
        sources.forEach((source) => { new Image().src = source; });
        const slider = element('input', {type: 'range', min: 0, max: frames.length - 1, value: 0,
                                         'aria-label': `Turn: ${frames[0].title}`});
        const words = element('span');
        let timer = null;
        function show(index) {
            const at = (Math.round(index) % frames.length + frames.length) % frames.length;
            slider.value = at;
            image.src = sources[at];
            image.alt = frames[at].caption;
            words.textContent = frames[at].caption;
        }
        function play() {
            if (timer !== null) clearInterval(timer);
            timer = timer === null ? setInterval(() => show(Number(slider.value) + 1), 1000 / 12) : null;
            button.textContent = timer === null ? 'Play' : 'Stop';
        }
        const button = element('button', {type: 'button', onclick: play}, 'Play');
        slider.addEventListener('input', () => show(slider.value));
        // A drag across the whole picture turns it once.
        let held = null;
        image.draggable = false;
        image.addEventListener('pointerdown', (event) => {
            held = {x: event.clientX, index: Number(slider.value)};
            image.setPointerCapture(event.pointerId);
        });
        image.addEventListener('pointermove', (event) => {
            if (held) show(held.index + (event.clientX - held.x) / image.clientWidth * frames.length);
        });
        for (const end of ['pointerup', 'pointercancel']) image.addEventListener(end, () => { held = null; });
        const figure = figureOf({...frames[0], caption: words}, [image,
            element('div', {class: 'turn'}, button, slider)]);
        figure.classList.add('turntable');
        show(0);
        return figure;
    }

    // --- The enlarged picture -------------------------------------------------------------------

    // A modal dialog: the browser keeps the focus within, closes it by Esc, and gives the focus back.
    const count = element('span', {class: 'count', 'aria-live': 'polite'});
    const file = element('a', {}, 'Save');
    const stage = element('div', {class: 'stage', onclick: () => dialog.close()});
    const words = element('p');
    const dialog = element('dialog', {'aria-label': 'Enlarged picture'},
        element('div', {class: 'bar'}, count, file,
            element('button', {type: 'button', 'aria-label': 'Previous picture', onclick: () => step(-1)}, '←'),
            element('button', {type: 'button', 'aria-label': 'Next picture', onclick: () => step(1)}, '→'),
            element('button', {type: 'button', 'aria-label': 'Close', autofocus: '', onclick: () => dialog.close()}, '✕')),
        stage, words);
    let enlarged = 0;
    function enlarge(index) {
        enlarged = index;
        const picture = shown[index];
        count.textContent = `${index + 1} of ${shown.length}`;
        file.href = images.get(picture.file).src;
        file.download = picture.file;
        dialog.dataset.name = picture.name;
        const image = imageOf(picture);
        const scale = picture.width < 600 ? 2 : 1;
        image.width = picture.width * scale;
        image.height = picture.height * scale;
        stage.replaceChildren(image);
        words.replaceChildren(element('b', {}, picture.title), picture.caption ? ` ${picture.caption}` : '');
        if (!dialog.open) dialog.showModal();
    }
    function step(by) {
        enlarge((enlarged + by + shown.length) % shown.length);
    }
    dialog.addEventListener('keydown', (event) => {
        if (event.key === 'ArrowLeft') step(-1);
        if (event.key === 'ArrowRight') step(1);
    });

    // --- What the page says ---------------------------------------------------------------------

    const extent = (asset) => asset.size.join(' × ');
    const totalBytes = (asset) => asset.files.length === 0
        ? null : asset.files.reduce((sum, entry) => sum + entry.bytes, 0);

    function anchor(title) {
        return `s-${encodeURIComponent(title)}`;
    }

    function skyError(asset) {
        return asset.error ? asset.error.sky : null;
    }
    function skyFigure(asset, name) {
        const sky = skyError(asset);
        return amount(sky && sky.points > 0 ? sky[name] : null, percent);
    }
    function percent(share) {
        return `${figure(100 * share)} %`;
    }

    function overview() {
        // Of a recipe nothing is written.
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
        const sky = skyError(asset);
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
    function sweepSection(sweep) {
        const columns = [{title: ''}, ...sweep.columns];
        const rows = sweep.rows.map((row) => [
            {text: '', value: null, content: row.picture ? pictureButton(row.picture) : ''},
            ...row.cells.map((cell, i) => cell.text !== null ? cell
                : amount(cell.value, sweep.columns[i].error ? figure : number)),
        ]);
        return element('section', {id: anchor('Sweep')}, element('h2', {}, 'Sweep'),
            element('p', {class: 'lead'}, sweep.content), gallery(sweep.pictures),
            sortableTable(columns, rows, 'Variants of the sweep'));
    }

    function notice(notes) {
        if (notes.length === 0) return null;
        return element('div', {class: 'notice'}, notes.length === 1 ? notes[0]
            : element('ul', {}, ...notes.map((note) => element('li', {}, note))));
    }

    // What is to be looked at comes first: the sweep, all clouds in one sky, clouds in their light, the
    // sky, then all others. The first picture stands above all words but the page's name.
    const isLit = (asset) => asset.pictures.some((picture) => picture.kind === 'scene');
    const [skies, ones] = [preview.scenes.filter((scene) => !scene.clouds),
                           preview.scenes.filter((scene) => scene.clouds)];
    const sections = [
        ...(preview.sweep ? [['Sweep', () => sweepSection(preview.sweep)]] : []),
        ...ones.map((scene) => [scene.title, () => sceneSection(scene)]),
        ...preview.assets.filter(isLit).map((asset) => [asset.name, () => assetSection(asset)]),
        ...skies.map((scene) => [scene.title, () => sceneSection(scene)]),
        ...preview.assets.filter((asset) => !isLit(asset)).map((asset) => [asset.name, () => assetSection(asset)]),
    ];
    const [first, ...others] = sections.map(([, made]) => made());
    document.body.append(
        element('main', {},
            element('header', {}, element('h1', {}, preview.title),
                element('div', {id: 'diagnostics', 'aria-live': 'polite'})),
            first,
            notice(preview.notes),
            sections.length > 1 ? element('nav', {'aria-label': 'Sections'}, ...sections.map(
                ([title]) => element('a', {href: `#${anchor(title)}`}, title))) : null,
            ...others,
            preview.assets.length > 0 ? overview() : null,
            element('footer', {}, element('p', {class: 'overline'}, preview.generator))),
        dialog);
    standing.remove();
})();
