// Draws a folder of skybake's with WebGL 2.
import {load_baked, text_of} from '../baked.js';
import {uniforms_of} from '../view.js';

// Formats of texels by the manifest's pixel type and number of channels; WebGL 2 filters all of them.
const formats = (gl) => ({
    unorm8: {type: gl.UNSIGNED_BYTE, internal: [, gl.R8, , gl.RGB8, gl.RGBA8]},
    half: {type: gl.HALF_FLOAT, internal: [, gl.R16F, , gl.RGB16F, gl.RGBA16F]},
});

// Binds a new texture that wraps and filters as the asset's mapping says.
function bind_texture(gl, {pixel_type, channels, size, axes, texels}) {
    const {type, internal} = formats(gl)[pixel_type];
    const format = [, gl.RED, , gl.RGB, gl.RGBA][channels];
    const target = size.length === 3 ? gl.TEXTURE_3D : gl.TEXTURE_2D;
    gl.bindTexture(target, gl.createTexture());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const upload = target === gl.TEXTURE_3D ? 'texImage3D' : 'texImage2D';
    gl[upload](target, 0, internal[channels], ...size, 0, format, type, texels);
    axes.forEach(({wrap, filter}, i) => {
        const name = [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R][i];
        gl.texParameteri(target, name, wrap === 'repeat' ? gl.REPEAT : gl.CLAMP_TO_EDGE);
        for (const end of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
            gl.texParameteri(target, end, filter === 'nearest' ? gl.NEAREST : gl.LINEAR);
        }
    });
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

async function shader_of(folder) {
    const here = (name) => new URL(name, import.meta.url);
    const parts = await Promise.all([here('head.glsl'), `${folder}/lookups.glsl`,
        here('../glsl/picture.glsl')].map(text_of));
    return parts.join('\n');
}

// Returns `draw`, which takes a view. The fragment shader looks up each asset by a sampler NAME_table.
export async function renderer(canvas, folder, shader = shader_of(folder)) {
    const gl = canvas.getContext('webgl2', {antialias: false, preserveDrawingBuffer: true});
    const assets = await load_baked(folder, ['transmittance', 'multiple_scattering', 'cloud', 'cells']);
    const program = linked(gl, await shader);
    gl.useProgram(program);
    assets.forEach((asset, unit) => {
        gl.activeTexture(gl.TEXTURE0 + unit);
        bind_texture(gl, asset);
        gl.uniform1i(gl.getUniformLocation(program, `${asset.name}_table`), unit);
    });
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, gl.createBuffer());

    return (view) => {
        [canvas.width, canvas.height] = view.size;
        gl.viewport(0, 0, ...view.size);
        gl.bufferData(gl.UNIFORM_BUFFER, uniforms_of(view), gl.DYNAMIC_DRAW);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    };
}
