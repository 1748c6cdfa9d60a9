'use strict';
// Draws a scene (live_scene.h) with WebGL 2. A picture is first drawn rough, in few pixels, and then fine, a strip of
// rows at a time, so that no frame takes long; further samples of each pixel follow.

async function unpacked(base64) {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(stream).arrayBuffer();
}

const radians = Math.PI / 180;
function direction(elevation, azimuth) {
    const level = Math.cos(elevation * radians);
    return [level * Math.cos(azimuth * radians), level * Math.sin(azimuth * radians), Math.sin(elevation * radians)];
}

class LiveRenderer {
    // Throws an Error that says what the browser lacks.
    constructor(canvas, shaders) {
        this.canvas = canvas;
        this.shaders = shaders;
        this.gl = canvas.getContext('webgl2', {antialias: false, alpha: false, preserveDrawingBuffer: true});
        if (!this.gl) throw new Error('this browser has no WebGL 2');
        if (!this.gl.getExtension('EXT_color_buffer_float')) throw new Error('this browser cannot draw into floats');
        this.filters_floats = Boolean(this.gl.getExtension('OES_texture_float_linear'));
        this.textures = new Map();
        this.targets = new Map();
        this.passes = 0;
        this.rows = 0;
        this.speed = 200;  // pixels a millisecond, measured as it draws: the first picture is there soon anywhere
    }

    // Replaces what is drawn. The camera is the caller's.
    async load(scene) {
        const loaded = await Promise.all(scene.textures.map(async (texture) => {
            const buffer = await unpacked(texture.texels);
            const arrays = {float: Float32Array, half: Uint16Array, unorm8: Uint8Array};
            return {...texture, texels: null, array: new arrays[texture.type](buffer)};
        }));
        const most = this.gl.getParameter(this.gl.MAX_3D_TEXTURE_SIZE);
        const large = loaded.find(({size}) => size.length === 3 && Math.max(...size) > most);
        if (large) throw new Error(`${large.label} has ${large.size.join(' × ')} voxels; this browser has ${most} along an edge`);
        this.check_units(scene);
        const programs = this.programs_of(scene);
        for (const {texture} of this.textures.values()) this.gl.deleteTexture(texture);
        this.textures.clear();
        this.scene = scene;
        this.programs = programs;
        for (const texture of loaded) this.upload(texture);
        const volumes = scene.clouds.map((_, i) => loaded.find(({name}) => name === `cloud_table_${i}`));
        this.clouds = volumes.length > 0 ? new LiveClouds(scene.clouds, volumes) : null;
        this.shared_at = null;
        this.restart();
    }

    // Shaders read the scene's textures, and of the page's own the light around clouds, that within, and what is drawn.
    check_units(scene) {
        const needed = scene.textures.length + (scene.clouds.length > 0 ? 3 : 1);
        const units = this.gl.getParameter(this.gl.MAX_TEXTURE_IMAGE_UNITS);
        if (needed <= units) return;
        throw new Error(`${scene.clouds.length} layers of clouds need ${needed} textures at once, and this browser has ${units}`);
    }

    programs_of(scene) {
        const {shaders} = this, cloudy = scene.clouds.length > 0;
        const head = '#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n' +
            'precision highp sampler3D;\n' + (cloudy ? '#define CLOUDS_OF_RECIPE\n' : '');
        const air = scene.air + shaders.sky, clouds = cloudy ? scene.cloud_glsl + shaders.tiles + shaders.clouds : '';
        return {
            picture: this.program(head + air + clouds + shaders.picture),
            light: cloudy ? this.program(head + air + clouds + shaders.light) : null,
            direct: cloudy ? this.program(head + air + clouds + shaders.direct) : null,
            screen: this.program(head + shaders.screen),
        };
    }

    program(fragment) {
        const {gl} = this, program = gl.createProgram();
        const vertex = '#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, ' +
            'gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }';
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
        return {program, places: new Map()};
    }

    // Floats are stored as halves where they could not be filtered. Grids of cells are fetched without a filter.
    upload({name, label, size, channels, type, array}) {
        const {gl} = this, flat = size.length === 2, target = flat ? gl.TEXTURE_2D : gl.TEXTURE_3D;
        const filtered = !/^(cells_table_\d+|phase_rows|shift_table)$/.test(name);
        const wide = type === 'float' && (this.filters_floats || !filtered);
        const internal = type === 'unorm8' ? [, gl.R8, gl.RG8, gl.RGB8, gl.RGBA8]
            : wide ? [, gl.R32F, gl.RG32F, gl.RGB32F, gl.RGBA32F] : [, gl.R16F, gl.RG16F, gl.RGB16F, gl.RGBA16F];
        const source = {unorm8: gl.UNSIGNED_BYTE, half: gl.HALF_FLOAT, float: gl.FLOAT}[type];
        const filter = filtered ? gl.LINEAR : gl.NEAREST;
        const texture = gl.createTexture();
        gl.bindTexture(target, texture);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl[flat ? 'texImage2D' : 'texImage3D'](target, 0, internal[channels], ...size, 0,
            [, gl.RED, gl.RG, gl.RGB, gl.RGBA][channels], source, array);
        const wrap = name.startsWith('cloud_table') ? gl.REPEAT : gl.CLAMP_TO_EDGE;
        gl.texParameteri(target, gl.TEXTURE_WRAP_S, wrap);
        gl.texParameteri(target, gl.TEXTURE_WRAP_T, wrap);
        gl.texParameteri(target, gl.TEXTURE_WRAP_R, gl.CLAMP_TO_EDGE);
        gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter);
        const stored = type === 'unorm8' ? 'unorm8' : wide ? 'float' : 'half';
        const bytes = size.reduce((product, edge) => product * edge, channels) * {unorm8: 1, half: 2, float: 4}[stored];
        this.textures.set(name, {texture, target, label, size, channels, stored, bytes});
    }

    // A float picture to draw into.
    target(name, width, height) {
        const {gl} = this, known = this.targets.get(name);
        if (known && known.width === width && known.height === height) return known;
        if (known) {
            gl.deleteTexture(known.texture);
            gl.deleteFramebuffer(known.frame);
        }
        const texture = gl.createTexture(), frame = gl.createFramebuffer();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
        const made = {texture, frame, width, height, target: gl.TEXTURE_2D};
        this.targets.set(name, made);
        return made;
    }

    // Draws a program into rows of a target, or to the screen.
    run({program, places}, to, values, first_row = 0, rows = to.height) {
        const {gl} = this;
        gl.useProgram(program);
        gl.bindFramebuffer(gl.FRAMEBUFFER, to.frame);
        gl.viewport(0, 0, to.width, to.height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(0, first_row, to.width, rows);
        const place = (name) => {
            if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
            return places.get(name);
        };
        let unit = 0;
        for (const [name, value] of Object.entries(values)) {
            const at = place(name);
            if (at === null) continue;
            if (value.texture) {
                gl.activeTexture(gl.TEXTURE0 + unit);
                gl.bindTexture(value.target, value.texture);
                gl.uniform1i(at, unit++);
            } else if (value.array) {
                gl[`uniform${value.width}fv`](at, value.array);
            } else if (Array.isArray(value)) {
                gl[`uniform${value.length}fv`](at, value);
            } else if (typeof value === 'boolean' || value.integer !== undefined) {
                gl.uniform1i(at, typeof value === 'boolean' ? value : value.integer);
            } else {
                gl.uniform1f(at, value);
            }
        }
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        for (let i = 0; i < unit; ++i) {
            gl.activeTexture(gl.TEXTURE0 + i);
            gl.bindTexture(gl.TEXTURE_2D, null);
            gl.bindTexture(gl.TEXTURE_3D, null);
        }
    }

    restart() { this.passes = this.rows = 0; }

    // The values of all shaders. `coarse` lengthens the steps of a march.
    values_of(view, width, height, coarse) {
        const sun = direction(view.sun_elevation, view.sun_azimuth), values = {
            ...Object.fromEntries(this.textures), sun, camera: view.position,
            forward: direction(view.pitch, view.heading), right: direction(0, view.heading - 90),
            up: direction(view.pitch + 90, view.heading), size: [width, height],
            tan_half_fov: Math.tan(0.5 * view.fov * radians), has_disc: view.disc, has_glare: view.glare, has_shadow: view.shadow,
            offset: [0, 0], rank: 0, weight: 1,
        };
        if (!this.clouds) return values;
        return {...values, ...this.clouds.values(view, sun, coarse), light_table: this.targets.get('light')};
    }

    // The light around the clouds, anew where the sun or the clouds have changed.
    prepare(view) {
        if (!this.clouds) return;
        const {clouds, gl} = this, count = clouds.clouds.length;
        if (this.shared_at !== view.extinction) {
            const known = this.textures.get('share_table');
            if (known) gl.deleteTexture(known.texture);
            this.upload(clouds.share_table(view.extinction));
            this.shared_at = view.extinction;
            this.lit_at = null;
        }
        const lit_at = `${view.sun_elevation} ${view.sun_azimuth} ${view.single}`;
        if (this.lit_at === lit_at) return;
        const radiance = this.target('radiance', 128, 64 * (count + 1)), light = this.target('light', 4, count + 1);
        const {light_table, ...values} = this.values_of(view, 4, 1, 1);
        // A texture is never read while it is drawn into.
        this.run(this.programs.light, radiance, {...values, radiance_table: light, sums: false});
        this.run(this.programs.light, light, {...values, radiance_table: radiance, sums: true});
        const direct = this.target('direct', 32, 32 * count);
        this.run(this.programs.direct, direct, values);
        clouds.take_direct(this.pixels(direct));
        this.lit_at = lit_at;
    }

    // Waits until all is drawn, so that time can be measured.
    finish(target) {
        const {gl} = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, new Float32Array(4));
    }

    measure(pixels, start) {
        const speed = pixels / Math.max(performance.now() - start, 0.1);
        this.speed = 0.5 * this.speed + 0.5 * speed;
    }

    // Draws all pixels roughly, in about `budget` ms. The rough picture stays behind the fine one.
    draw_rough(view, width, height, budget) {
        this.prepare(view);
        const share = Math.min(1, Math.max(0.1, Math.sqrt(this.speed * budget / (width * height))));
        const rough = this.target('rough', Math.max(1, Math.round(width * share)), Math.max(1, Math.round(height * share)));
        const start = performance.now();
        this.run(this.programs.picture, rough, {...this.values_of(view, rough.width, rough.height, share < 1 ? 2 : 1), before: this.target('none', 1, 1)});
        this.finish(rough);
        this.measure(rough.width * rough.height, start);
        this.restart();
        return rough;
    }

    // Draws some more rows of the fine picture; returns whether a pass ended. `sample` is another place and noise than
    // those of the pass.
    draw_fine(view, width, height, budget, sample) {
        this.prepare(view);
        const to = this.target(`fine${this.passes % 2}`, width, height), before = this.target(`fine${(this.passes + 1) % 2}`, width, height);
        const rows = Math.min(height - this.rows, Math.max(1, Math.round(this.speed * budget / width)));
        const n = this.passes, rank_share = (step) => n === 0 ? 0 : (0.5 + n * step) % 1 - 0.5;
        const start = performance.now();
        this.run(this.programs.picture, to, {...this.values_of(view, width, height, 1), before, rank: n,
            weight: 1 / (n + 1), offset: [rank_share(0.7548776662), rank_share(0.5698402910)], ...sample},
        height - this.rows - rows, rows);
        this.finish(to);
        this.measure(rows * width, start);
        this.rows += rows;
        if (this.rows < height) return false;
        this.rows = 0;
        ++this.passes;
        return true;
    }

    // Shows what there is: the last whole pass, or the rows of the first one before the rough picture.
    show(view, width, height) {
        if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
        const fine = this.target(`fine${this.passes === 0 ? 0 : (this.passes - 1) % 2}`, width, height);
        this.run(this.programs.screen, {frame: null, width, height}, {
            fine, rough: this.targets.get('rough') || fine, size: [width, height],
            rows_done: this.passes > 0 ? height : this.rows, exposure: 2 ** view.exposure,
            curve: {integer: ['film', 'exponential', 'aces', 'agx'].indexOf(view.tone_curve)}});
    }

    // The pixels of a picture as floats: linear light, and reads of the cloud and its grid.
    pixels(target) {
        const {gl} = this, floats = new Float32Array(4 * target.width * target.height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
        gl.readPixels(0, 0, target.width, target.height, gl.RGBA, gl.FLOAT, floats);
        return floats;
    }

    memory() { return [...this.textures.values()].reduce((sum, {bytes}) => sum + bytes, 0); }
}
