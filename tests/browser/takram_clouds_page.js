// The textures of @takram/three-clouds by the loaders that the package uses (r3f/Clouds.tsx), with the options that it
// gives them. Runs in the page of takram_clouds.js.
import {CLOUD_SHAPE_DETAIL_TEXTURE_SIZE, CLOUD_SHAPE_TEXTURE_SIZE, CloudsEffect} from '@takram/three-clouds';
import {PrecomputedTexturesLoader} from '@takram/three-atmosphere';
import {DataTextureLoader, parseUint8Array, STBNLoader} from '@takram/three-geospatial';
import {EffectComposer, EffectPass, RenderPass} from 'postprocessing';
import * as THREE from 'three';

const loaded = (loader, url) => new Promise((resolve, reject) => loader.load(url, resolve, undefined, reject));

async function picture(url) {
    const texture = await loaded(new THREE.TextureLoader(), url);
    texture.minFilter = THREE.LinearMipMapLinearFilter;
    texture.magFilter = THREE.LinearFilter;
    texture.wrapS = THREE.RepeatWrapping;
    texture.wrapT = THREE.RepeatWrapping;
    texture.colorSpace = THREE.NoColorSpace;
    texture.needsUpdate = true;
    return texture;
}

const volume = (size) => (url) => loaded(new DataTextureLoader(THREE.Data3DTexture, parseUint8Array, {
    width: size, height: size, depth: size, format: THREE.RedFormat,
    minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter,
    wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, wrapR: THREE.RepeatWrapping,
    colorSpace: THREE.NoColorSpace,
}), url);

const loaders = {
    local_weather: picture,
    turbulence: picture,
    shape: volume(CLOUD_SHAPE_TEXTURE_SIZE),
    shape_detail: volume(CLOUD_SHAPE_DETAIL_TEXTURE_SIZE),
    stbn: (url) => loaded(new STBNLoader(), url),
};

// The values, four of each place, of a texture of that name. `upside_down` exchanges v for 1 - v.
window.look_up = async (name, url, places, upside_down) => {
    const renderer = new THREE.WebGLRenderer();
    const texture = await loaders[name](url);
    const is_volume = texture.isData3DTexture === true;
    const count = places.length / 4;
    const at = new THREE.DataTexture(new Float32Array(places), count, 1, THREE.RGBAFormat, THREE.FloatType);
    at.needsUpdate = true;
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        uniforms: {places: {value: at}, table: {value: texture}},
        vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
        fragmentShader: `
            precision highp float;
            uniform highp sampler2D places;
            uniform highp sampler${is_volume ? '3D' : '2D'} table;
            out vec4 color;
            void main() {
                vec4 at = texelFetch(places, ivec2(int(gl_FragCoord.x), 0), 0);
                ${upside_down ? 'at.y = 1.0 - at.y;' : ''}
                color = textureLod(table, ${is_volume ? 'at.xyz' : 'at.xy'}, 0.0);
            }`,
    });
    const target = new THREE.WebGLRenderTarget(count, 1, {type: THREE.FloatType});
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    quad.frustumCulled = false;
    renderer.setRenderTarget(target);
    renderer.render(new THREE.Scene().add(quad), new THREE.Camera());
    const values = new Float32Array(4 * count);
    renderer.readRenderTargetPixels(target, 0, 0, count, 1, values);
    renderer.dispose();
    return Array.from(values);
};

// Changes of a texture: nothing, all numbers 0, or all in the opposite order.
const changes = {
    nothing: (data) => data,
    zeros: (data) => data.fill(0),
    reversed: (data) => data.reverse(),
};

// A picture that was loaded is exchanged for its numbers, so that they can be changed.
function changed(renderer, texture, change) {
    if (texture.isData3DTexture) {
        changes[change](texture.image.data);
        return texture;
    }
    const {width, height} = texture.image;
    const numbers = Uint8Array.from(copied(renderer, texture, [width, height]), (value) => Math.round(255 * value));
    const other = new THREE.DataTexture(changes[change](numbers), width, height, THREE.RGBAFormat);
    for (const key of ['minFilter', 'magFilter', 'wrapS', 'wrapT', 'colorSpace']) other[key] = texture[key];
    other.generateMipmaps = true;
    other.needsUpdate = true;
    return other;
}

const files = {local_weather: 'local_weather.png', shape: 'shape.bin', shape_detail: 'shape_detail.bin',
               turbulence: 'turbulence.png', stbn: 'stbn.bin'};
const attributes = {local_weather: 'localWeatherTexture', shape: 'shapeTexture', shape_detail: 'shapeDetailTexture',
                    turbulence: 'turbulenceTexture', stbn: 'stbnTexture'};

// `folders` are those of the textures, by their names.
async function effect_with(camera, folders, atmosphere) {
    const effect = new CloudsEffect(camera);
    effect.qualityPreset = 'low';
    effect.shapeDetail = effect.turbulence = true;
    effect.temporalUpscale = effect.shadow.temporalPass = effect.haze = false;
    effect.sunDirection.set(0.7, 0.4, 0.5).normalize();
    Object.assign(effect, await new PrecomputedTexturesLoader({format: 'exr'}).loadAsync(atmosphere));
    for (const [name, attribute] of Object.entries(attributes)) {
        effect[attribute] = await loaders[name](`${folders[name]}${files[name]}`);
    }
    return effect;
}

// The package's clouds from below them, where the equator meets the first meridian: pictures of R G B A, the light of
// the clouds and how much they cover. The first one has the textures as they are. Each further one has one change: the
// name of a texture, and what is wrong with it.
window.draw_clouds = async ({folders, atmosphere, size, wrong}) => {
    const renderer = new THREE.WebGLRenderer();
    renderer.setSize(...size, false);
    const camera = new THREE.PerspectiveCamera(75, size[0] / size[1], 1, 4e5);
    camera.position.set(6378137 + 300, 0, 0);
    camera.up.set(1, 0, 0);
    camera.lookAt(camera.position.clone().add(new THREE.Vector3(0.6, 1, 0)));
    camera.updateMatrixWorld();
    const effect = await effect_with(camera, folders, atmosphere);
    const composer = new EffectComposer(renderer, {frameBufferType: THREE.HalfFloatType});
    composer.addPass(new RenderPass(new THREE.Scene(), camera));
    composer.addPass(new EffectPass(camera, effect));
    const drawn = () => {
        effect.frame = 0;  // chooses the slice of stbn
        composer.render(0);
        return copied(renderer, effect.cloudsPass.currentRenderTarget.texture, size);  // before frames are blended
    };
    for (let i = 0; i < 3; ++i) drawn();  // the first ones have the shadows of other frames
    const pictures = [drawn()];
    for (const [name, change] of wrong) {
        const right = effect[attributes[name]];
        effect[attributes[name]] = changed(renderer, await loaders[name](`${folders[name]}${files[name]}`), change);
        pictures.push(drawn());
        effect[attributes[name]] = right;
    }
    return pictures;
};

function copied(renderer, texture, size) {
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3, uniforms: {table: {value: texture}},
        vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
        fragmentShader: `precision highp float;
            uniform sampler2D table;
            out vec4 color;
            void main() { color = texelFetch(table, ivec2(gl_FragCoord.xy), 0); }`,
    });
    const target = new THREE.WebGLRenderTarget(...size, {type: THREE.FloatType});
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    quad.frustumCulled = false;
    renderer.setRenderTarget(target);
    renderer.render(new THREE.Scene().add(quad), new THREE.Camera());
    const pixels = new Float32Array(4 * size[0] * size[1]);
    renderer.readRenderTargetPixels(target, 0, 0, ...size, pixels);
    return Array.from(pixels);
}
