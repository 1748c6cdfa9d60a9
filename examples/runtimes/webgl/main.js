// Loads a folder of skybake's by its manifest.json and draws it with WebGL 2. `draw` takes a view:
// {position: [x, y, z] m, heading, pitch, fov, sun_elevation, sun_azimuth: degrees, exposure, size: pixels}.
// Azimuths and headings turn from +x towards +y.

const text_of = async (url) => (await fetch(url)).text();

// Formats of texels by the manifest's pixel type and number of channels; WebGL 2 filters all of them.
const formats = (gl) => ({
    unorm8: {array: Uint8Array, type: gl.UNSIGNED_BYTE, internal: [, gl.R8, , gl.RGB8, gl.RGBA8]},
    half: {array: Uint16Array, type: gl.HALF_FLOAT, internal: [, gl.R16F, , gl.RGB16F, gl.RGBA16F]},
});

// A texture of level 0 of an asset, wrapped and filtered as its mapping says.
async function load_texture(gl, folder, asset) {
    const file = asset.files.find(({format, level}) => format === 'bin' && level === 0);
    const {array, type, internal} = formats(gl)[file.pixel_type];
    const texels = new array(await (await fetch(`${folder}/${file.path}`)).arrayBuffer());
    const channels = asset.channels.length, format = [, gl.RED, , gl.RGB, gl.RGBA][channels];
    const target = asset.size.length === 3 ? gl.TEXTURE_3D : gl.TEXTURE_2D;
    const texture = gl.createTexture();
    gl.bindTexture(target, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const upload = target === gl.TEXTURE_3D ? 'texImage3D' : 'texImage2D';
    gl[upload](target, 0, internal[channels], ...asset.size, 0, format, type, texels);
    const axes = {u: gl.TEXTURE_WRAP_S, v: gl.TEXTURE_WRAP_T, w: gl.TEXTURE_WRAP_R};
    for (const [axis, name] of Object.entries(axes)) {
        if (!asset.mapping[axis]) continue;
        gl.texParameteri(target, name, asset.mapping[axis].wrap === 'repeat' ? gl.REPEAT : gl.CLAMP_TO_EDGE);
        const filter = asset.mapping[axis].filter === 'nearest' ? gl.NEAREST : gl.LINEAR;
        gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter);
    }
    return {target, texture};
}

function linked(gl, fragment) {
    const program = gl.createProgram();
    const vertex = `#version 300 es
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
}

// Returns `draw`. `names` are the assets that the shaders look up, each by a sampler NAME_table.
export async function renderer(canvas, folder, names = ['transmittance', 'multiple_scattering', 'cloud', 'cells']) {
    const gl = canvas.getContext('webgl2', {antialias: false, preserveDrawingBuffer: true});
    const manifest = JSON.parse(await text_of(`${folder}/manifest.json`));
    const assets = names.map((name) => manifest.assets.find((asset) => asset.name === name));
    const textures = await Promise.all(assets.map((asset) => load_texture(gl, folder, asset)));
    const lookups = await Promise.all(names.map((name) => text_of(`${folder}/${name}.glsl`)));
    const shaders = await Promise.all(['sky', 'clouds', 'picture'].map((name) => text_of(new URL(`${name}.glsl`, import.meta.url))));
    // Lookups of two files may share functions, which are paragraphs.
    const paragraphs = new Set(lookups.join('\n\n').split(/\n\n+/));
    const program = linked(gl, ['#version 300 es\nprecision highp float;\nprecision highp int;',
        'precision highp sampler2D;\nprecision highp sampler3D;', ...paragraphs, ...shaders].join('\n'));
    const place = (name) => gl.getUniformLocation(program, name);
    const radians = Math.PI / 180;
    const direction = (elevation, azimuth) => [Math.cos(elevation * radians) * Math.cos(azimuth * radians),
        Math.cos(elevation * radians) * Math.sin(azimuth * radians), Math.sin(elevation * radians)];

    return (view) => {
        [canvas.width, canvas.height] = view.size;
        gl.viewport(0, 0, ...view.size);
        gl.useProgram(program);
        textures.forEach(({target, texture}, i) => {
            gl.activeTexture(gl.TEXTURE0 + i);
            gl.bindTexture(target, texture);
            gl.uniform1i(place(`${names[i]}_table`), i);
        });
        gl.uniform3fv(place('camera'), view.position);
        gl.uniform3fv(place('forward'), direction(view.pitch, view.heading));
        gl.uniform3fv(place('right'), direction(0, view.heading - 90));
        gl.uniform3fv(place('up'), direction(view.pitch + 90, view.heading));
        gl.uniform3fv(place('sun'), direction(view.sun_elevation, view.sun_azimuth));
        gl.uniform2fv(place('size'), view.size);
        gl.uniform1f(place('tan_half_fov'), Math.tan(0.5 * view.fov * radians));
        gl.uniform1f(place('exposure'), view.exposure);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    };
}
