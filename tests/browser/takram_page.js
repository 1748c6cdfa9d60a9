// The sky of @takram/three-atmosphere as its users have it: with its loader, its material and its
// parameters. Runs in the page of takram_sky.js.
import {AtmosphereParameters, DensityProfileLayer, PrecomputedTexturesLoader,
        SkyMaterial} from '@takram/three-atmosphere';
import {Color, FloatType, Mesh, PerspectiveCamera, PlaneGeometry, Scene, Uniform, Vector3,
        WebGLRenderer, WebGLRenderTarget} from 'three';
import {EXRLoader} from 'three/addons/loaders/EXRLoader.js';

const radians = (degrees) => degrees * Math.PI / 180;
const renderer = new WebGLRenderer();

// From the file beside the tables, in which vectors are arrays. Luminances are radiances.
async function load_atmosphere(url) {
    const values = await (await fetch(url)).json();
    for (const [key, value] of Object.entries(values)) {
        if (key.endsWith('Density')) {
            values[key] = value.map((layer) => new DensityProfileLayer(
                layer.width, layer.expTerm, layer.expScale, layer.linearTerm, layer.constantTerm));
        } else if (Array.isArray(value)) {
            values[key] = key === 'groundAlbedo' ? new Color(...value) : new Vector3(...value);
        }
    }
    const one = new Vector3(1, 1, 1);
    return new AtmosphereParameters({...values, skyRadianceToLuminance: one, sunRadianceToLuminance: one});
}

const load_textures = (folder, options) => new Promise((resolve, reject) => {
    new PrecomputedTexturesLoader(options).load(folder, resolve, undefined, reject);
});

function turn_upside_down({data, width}) {
    const length = 4 * width;
    for (let low = 0, high = data.length - length; low < high; low += length, high -= length) {
        const row = data.slice(low, low + length);
        data.copyWithin(low, high, high + length);
        data.set(row, high);
    }
}

// A direction by its angles in degrees, the azimuth to the right from the sun's; z is up.
const direction = (azimuth, elevation) => new Vector3(
    Math.cos(radians(elevation)) * Math.cos(radians(azimuth)),
    -Math.cos(radians(elevation)) * Math.sin(radians(azimuth)), Math.sin(radians(elevation)));

function camera_of(view, atmosphere) {
    const camera = new PerspectiveCamera(view.fov, view.size[0] / view.size[1]);
    camera.position.set(0, 0, atmosphere.bottomRadius + 1000 * view.altitude_km);
    camera.up.set(0, 0, 1);
    camera.lookAt(camera.position.clone().add(direction(view.heading, view.pitch)));
    camera.updateMatrixWorld();
    return camera;
}

// SkyMaterial is made for the atmosphere by default, and has no option for another.
function set_atmosphere(material, atmosphere) {
    material.uniforms.ATMOSPHERE = atmosphere.toUniform();
    material.uniforms.SUN_SPECTRAL_RADIANCE_TO_LUMINANCE = new Uniform(atmosphere.sunRadianceToRelativeLuminance);
    material.uniforms.SKY_SPECTRAL_RADIANCE_TO_LUMINANCE = new Uniform(atmosphere.skyRadianceToRelativeLuminance);
}

// R G B, rows from the top, in 1/sr for a solar irradiance of 1.
function render(textures, atmosphere, view) {
    const [width, height] = view.size;
    const material = new SkyMaterial({
        ...textures, correctAltitude: false, sun: false, moon: false,
        groundAlbedo: view.shows_ground ? atmosphere.groundAlbedo : new Color(0),
        sunDirection: direction(0, view.sun_elevation),
    });
    set_atmosphere(material, atmosphere);
    const quad = new Mesh(new PlaneGeometry(2, 2), material);
    quad.frustumCulled = false;
    const target = new WebGLRenderTarget(width, height, {type: FloatType});
    const pixels = new Float32Array(4 * width * height);
    renderer.setRenderTarget(target);
    renderer.render(new Scene().add(quad), camera_of(view, atmosphere));
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    target.dispose();
    material.dispose();

    const unit = atmosphere.solarIrradiance.toArray();
    const picture = [];
    for (let y = height - 1; y >= 0; --y) {
        for (let x = 0; x < width; ++x) {
            for (let c = 0; c < 3; ++c) picture.push(pixels[4 * (y * width + x) + c] / unit[c]);
        }
    }
    return picture;
}

// `upside_down` turns the rows of scattering after loading.
window.render_views = async ({folder, parameters, upside_down, ...options}, views) => {
    const atmosphere = await load_atmosphere(parameters);
    const textures = await load_textures(folder, options);
    if (upside_down) turn_upside_down(textures.scatteringTexture.image);
    return views.map((view) => render(textures, atmosphere, view));
};

// R G B A, the last row of the file first.
window.read_exr = async (url) => {
    const {image} = await new EXRLoader().setDataType(FloatType).loadAsync(url);
    return {width: image.width, height: image.height, data: Array.from(image.data)};
};
