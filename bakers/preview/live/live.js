'use strict';
// The controls of a live page: a camera that looks by dragging and flies by keys, sliders, and figures.
(() => {
    const byId = (id) => document.getElementById(id);
    const canvas = byId('picture'), stage = byId('stage');
    const most_samples = 16;
    const page = {view: null, first: null, scene: null, renderer: null, keys: new Set(), stale: true, auto: true, fetches: null};
    window.skybakeLive = page;

    // --- The view ---------------------------------------------------------------------------------

    // Each slider with the words that stand for its value.
    const degrees = (value) => `${Number(value).toFixed(1)}°`;
    const sliders = {
        sun_elevation: degrees, sun_azimuth: degrees, fov: degrees,
        exposure: (value) => `${Number(value).toFixed(2)} stops`,
        extinction: (value) => `× ${(2 ** value).toFixed(2)}`,
    };

    const checks = ['disc', 'glare', 'shadow', 'single'];

    function first_view(scene) {
        const {view} = scene;
        return {...view, exposure: view.exposure ?? 3, extinction: 1, disc: true, shadow: true,
            single: scene.clouds.some((cloud) => !cloud.repeats)};
    }

    const slider_value = (name) => name === 'extinction' ? Math.log2(page.view.extinction) : page.view[name];

    function tell_controls() {
        for (const [name, words] of Object.entries(sliders)) {
            byId(name).value = slider_value(name);
            byId(name).setAttribute('aria-valuetext', words(slider_value(name)));
            byId(`${name}_value`).textContent = words(slider_value(name));
        }
        byId('tone_curve').value = page.view.tone_curve;
        byId('auto').checked = page.auto;
        for (const name of checks) byId(name).checked = page.view[name];
    }

    // Text in the form that --camera reads.
    function camera_text({position, heading, pitch, fov}) {
        const km = position.map((meters) => `${(meters / 1000).toFixed(3)}km`).join(',');
        return `position=${km} heading=${heading.toFixed(1)}deg pitch=${pitch.toFixed(1)}deg fov=${fov.toFixed(1)}deg`;
    }

    // The view with the parts that such a text names, or nothing if it holds anything else.
    function camera_of(text, view) {
        const seen = {...view}, number = '([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)';
        for (const part of text.trim().split(/\s+(?=[a-z]+=)/)) {
            const angle = part.match(new RegExp(`^(heading|pitch|fov)=${number} ?deg$`));
            const place = part.match(new RegExp(`^position=${number} ?(k?m), ?${number} ?(k?m), ?${number} ?(k?m)$`));
            if (angle) seen[angle[1]] = Number(angle[2]);
            else if (place) seen.position = [1, 3, 5].map((i) => Number(place[i]) * (place[i + 1] === 'km' ? 1000 : 1));
            else return null;
        }
        return {...seen, pitch: within(seen.pitch, -89, 89), fov: within(seen.fov, 10, 120),
            position: [...seen.position.slice(0, 2), within(seen.position[2], 2, seen.top)]};
    }
    const within = (value, low, high) => Math.min(Math.max(value, low), high);

    function changed(fits_exposure = false) {
        page.stale = true;
        if (fits_exposure && page.auto) page.fits_exposure = true;
        byId('camera').value = camera_text(page.view);
        byId('camera').setCustomValidity('');
    }
    byId('camera').addEventListener('focus', ({target}) => target.select());
    byId('camera').addEventListener('change', ({target}) => {
        const view = camera_of(target.value, page.view);
        target.setCustomValidity(view ? '' : 'for example: position=2km,0km,150m heading=63deg pitch=12deg fov=70deg');
        if (!target.reportValidity()) return;
        page.view = view;
        tell_controls();
        changed();
    });

    for (const name of Object.keys(sliders)) {
        byId(name).addEventListener('input', ({target}) => {
            page.view[name] = name === 'extinction' ? 2 ** Number(target.value) : Number(target.value);
            if (name === 'exposure') page.auto = false;
            tell_controls();
            changed(name !== 'exposure' && name !== 'fov');
        });
    }
    byId('tone_curve').addEventListener('change', ({target}) => {
        page.view.tone_curve = target.value;
        changed(true);
    });
    byId('auto').addEventListener('change', ({target}) => {
        page.auto = target.checked;
        changed(true);
    });
    for (const name of checks) {
        byId(name).addEventListener('change', ({target}) => {
            page.view[name] = target.checked;
            changed();
        });
    }
    byId('home').addEventListener('click', () => {
        page.view = structuredClone(page.first);
        page.auto = page.scene.view.exposure === null;
        tell_controls();
        changed(true);
    });

    // --- Looking and flying -----------------------------------------------------------------------

    function look(right, up) {
        page.view.heading = ((page.view.heading - right) % 360 + 360) % 360;
        page.view.pitch = within(page.view.pitch + up, -89, 89);
        changed();
    }
    function zoom(factor) {
        page.view.fov = within(page.view.fov * factor, 10, 120);
        tell_controls();
        changed();
    }
    canvas.addEventListener('wheel', (event) => {
        event.preventDefault();
        if (page.view) zoom(Math.exp(0.001 * within(event.deltaY, -300, 300)));
    }, {passive: false});

    // One finger or the mouse looks, two fingers zoom.
    const fingers = new Map();
    const apart = () => {
        const [a, b] = fingers.values();
        return Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 1);
    };
    canvas.addEventListener('pointerdown', (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener('pointermove', (event) => {
        const last = fingers.get(event.pointerId);
        if (!last || !page.view) return;
        const before = fingers.size === 2 ? apart() : 0, turn = page.view.fov / canvas.clientWidth;
        fingers.set(event.pointerId, [event.clientX, event.clientY]);
        if (fingers.size === 1) look(-(event.clientX - last[0]) * turn, (event.clientY - last[1]) * turn);
        if (fingers.size === 2) zoom(before / apart());
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));

    const flight = {KeyW: [1, 0, 0], KeyS: [-1, 0, 0], KeyA: [0, -1, 0], KeyD: [0, 1, 0], KeyE: [0, 0, 1], KeyQ: [0, 0, -1]};
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || !page.view) return;
        const types = event.target === byId('tone_curve') || event.target === byId('camera');
        if (flight[event.code] && !types) page.keys.add(event.code);
        if (turns[event.code] && event.target === canvas) {
            page.keys.add(event.code);
            event.preventDefault();
        }
        page.fast = event.shiftKey;
    });
    addEventListener('keyup', (event) => {
        page.keys.delete(event.code);
        page.fast = event.shiftKey;
    });
    addEventListener('blur', () => page.keys.clear());

    // Flies for so many seconds. The speed grows with the distance to the ground and to the clouds' base.
    function fly(seconds) {
        const {view} = page;
        for (const [code, [right, up]] of Object.entries(turns)) {
            if (page.keys.has(code)) look(40 * seconds * right, 40 * seconds * up);
        }
        const ways = [...page.keys].filter((code) => flight[code]);
        if (ways.length === 0) return;
        const speed = within(0.4 * view.position[2], 150, 20e3) * (page.fast ? 5 : 1);
        const axes = [direction(view.pitch, view.heading), direction(0, view.heading - 90), [0, 0, 1]];
        for (const code of ways) {
            flight[code].forEach((way, axis) => {
                for (let a = 0; a < 3; ++a) view.position[a] += way * speed * seconds * axes[axis][a];
            });
        }
        view.position[2] = within(view.position[2], 2, view.top);
        changed();
    }

    // --- Frames -----------------------------------------------------------------------------------

    // The factor of exposures by the sun's elevation, linear between those of the scene.
    function dimming(by_sun) {
        const {first_deg, step_deg, factors} = by_sun, last = factors.length - 1;
        const at = Math.max(0, Math.min(last, (page.view.sun_elevation - first_deg) / step_deg));
        const low = Math.min(Math.floor(at), last - 1);
        return factors[low] + (at - low) * (factors[low + 1] - factors[low]);
    }

    // Chooses the exposure by the scene's rule, which is that of the preview's pictures (tone_curve.h).
    function fit_exposure(target) {
        const rule = page.scene.exposure;
        const floats = page.renderer.pixels(target), luminances = [];
        for (let i = 0; i < floats.length; i += 4) {
            const luminance = 0.2126 * floats[i] + 0.7152 * floats[i + 1] + 0.0722 * floats[i + 2];
            if (luminance > 0 || !rule.lit_pixels) luminances.push(luminance);
        }
        luminances.sort((a, b) => a - b);
        const stops = (light, quantile) =>
            Math.log2(light[page.view.tone_curve] / luminances[Math.floor(quantile * (luminances.length - 1))]);
        let chosen = stops(rule.light, rule.quantile);
        const least = rule.least_median ? stops(rule.least_median, 0.5) : -Infinity;
        if (least < Infinity) chosen = Math.max(chosen, least);
        if (rule.bright_light) chosen = Math.min(chosen, stops(rule.bright_light, rule.bright_quantile));
        chosen += Math.log2(dimming(rule.dimming));
        if (Number.isFinite(chosen)) page.view.exposure = Math.max(-4, Math.min(30, chosen));
        page.fits_exposure = false;
        tell_controls();
    }

    function mean_fetches(target) {
        const floats = page.renderer.pixels(target);
        let sum = 0;
        for (let i = 3; i < floats.length; i += 4) sum += floats[i];
        return sum / (target.width * target.height);
    }

    const picture_size = () => {
        const ratio = Math.min(devicePixelRatio || 1, 2), box = stage.getBoundingClientRect();
        return [Math.max(16, Math.round(box.width * ratio)), Math.max(16, Math.round(box.height * ratio))];
    };

    function draw() {
        const {renderer, view} = page, [width, height] = picture_size();
        const resized = canvas.width !== width || canvas.height !== height;
        const start = performance.now();
        if (page.stale || resized) {
            page.stale = false;
            const rough = renderer.draw_rough(view, width, height, 25);
            if (page.fits_exposure) fit_exposure(rough);
            page.fetches = mean_fetches(rough);
            tell_figures(performance.now() - start, rough);
        } else if (renderer.passes < most_samples && fingers.size === 0) {
            if (renderer.draw_fine(view, width, height, 25) && renderer.passes === 1) {
                page.fetches = mean_fetches(renderer.targets.get('fine0'));
            }
            tell_figures(null, null);
        } else {
            return;
        }
        renderer.show(view, width, height);
        page.painted ??= performance.now();
        if (page.figures_due) {
            page.figures_due = false;
            tell_textures();
        }
        stage.classList.add('drawn');
    }

    function frame(now) {
        fly(Math.min(0.1, (now - (page.last || now)) / 1000));
        page.last = now;
        if (page.view && !page.halted) draw();
        requestAnimationFrame(frame);
    }

    // --- Figures ----------------------------------------------------------------------------------

    const mebibytes = (bytes) => bytes < 1 << 20 ? `${(bytes / 1024).toFixed(0)} KiB` : `${(bytes / (1 << 20)).toFixed(1)} MiB`;

    const time_words = (ms) => ms < 1000 ? `${ms.toFixed(ms < 100 ? 1 : 0)} ms` : ms < 120e3 ? `${(ms / 1000).toFixed(1)} s` : `${Math.round(ms / 60e3)} min`;

    function tell_figures(ms, rough) {
        const {renderer} = page, [width, height] = [canvas.width, canvas.height];
        if (rough) {
            byId('frame_time').textContent = `${time_words(ms)} at ${rough.width} × ${rough.height}`;
        }
        byId('full_time').textContent = `${time_words(width * height / renderer.speed)} at ${width} × ${height}`;
        byId('fetches').textContent = page.scene.clouds.length > 0 ? `${page.fetches.toFixed(1)} a pixel` : 'none: no cloud';
        byId('samples').textContent = renderer.passes > 0 ? `${renderer.passes} a pixel` : `the first one is ${Math.round(100 * renderer.rows / height)} % done`;
    }

    function tell_textures() {
        byId('memory').textContent = mebibytes(page.renderer.memory());
        byId('textures').replaceChildren(...[...page.renderer.textures.values()].map((texture) => {
            const row = document.createElement('tr');
            const type = `${'RGBA'.slice(0, texture.channels)} ${texture.stored}`;
            for (const text of [texture.label, texture.size.join(' × '), type, mebibytes(texture.bytes)]) {
                row.append(Object.assign(document.createElement('td'), {textContent: text}));
            }
            return row;
        }));
        const {clouds, light, notes} = page.scene;
        const errors = clouds.filter((cloud) => cloud.greatest_error > 0).map((cloud) =>
            ` The volume of ${cloud.name} on this page differs from the baked one by at most ${cloud.greatest_error.toPrecision(2)}.`).join('');
        const half = page.renderer.filters_floats ? '' : ' This browser cannot filter floats: tables are stored as halves, exact to 0.05 %.';
        byId('about').textContent = `The light is that of ${light}.` +
            clouds.map((cloud) => ` Rays leap in ${cloud.name} by ${cloud.leaps}.`).join('') + errors + half + notes.map((note) => ` Note: ${note}.`).join('');
    }

    // --- Scenes -----------------------------------------------------------------------------------

    // Replaces the textures; the camera, the sun and the sliders stay.
    async function replace(scene) {
        await page.renderer.load(scene);
        page.scene = scene;
        page.first = first_view(scene);
        page.view ??= structuredClone(page.first);
        page.auto = page.auto && scene.view.exposure === null;
        byId('clouds').hidden = byId('cloud_checks').hidden = scene.clouds.length === 0;
        tell_controls();
        changed(true);
        page.figures_due = true;
    }
    page.replace = replace;

    // For tests: one sample of each pixel, drawn at once. The page's own frames stop.
    page.render = (view, width, height, sample) => {
        page.halted = true;
        const whole = {...page.first, ...view};
        page.renderer.restart();
        while (!page.renderer.draw_fine(whole, width, height, 1000, sample));
        page.renderer.show(whole, width, height);
        return page.renderer.pixels(page.renderer.targets.get('fine0'));
    };

    function give_up(reason) {
        stage.classList.add('still');
        byId('reason').textContent = `There is no live picture: ${reason}. These pictures were drawn by skybake.`;
        document.body.classList.add('without');
    }

    async function begin() {
        try {
            const text = (id) => JSON.parse(byId(id).textContent);
            page.renderer = new LiveRenderer(canvas, text('shaders'));
            canvas.addEventListener('webglcontextlost', (event) => {
                event.preventDefault();
                page.halted = true;
                give_up('the browser has given up WebGL; reload the page');
            });
            await replace(text('scene'));
            page.ready = true;
            requestAnimationFrame(frame);
        } catch (error) {
            page.failed = String(error.stack);
            give_up(error.message);
        }
    }
    page.begun = begin();
})();
