$if KIND=bruneton$// Loads $FILE$ for @takram/three-atmosphere, as its PrecomputedTexturesLoader would: put both files beside
$if KIND=bruneton$// each other and give `await load()` to its materials as transmittanceTexture, scatteringTexture or whichever it is.
$if KIND=noise_volume$// Loads $FILE$ for @takram/three-clouds: put both files beside each other and set `await load()` as the
$if KIND=noise_volume$// effect's shapeTexture, shapeDetailTexture, localWeatherTexture or turbulenceTexture.
$if KIND=weather_map$// Loads $FILE$ for @takram/three-clouds: put both files beside each other and set `await load()` as the
$if KIND=weather_map$// effect's localWeatherTexture, or as its turbulenceTexture if the map holds directions.
$if KIND=blue_noise$// Loads $FILE$ for @takram/three-clouds: put both files beside each other and set `await load()` as the
$if KIND=blue_noise$// effect's stbnTexture. Its STBNLoader loads masks of 128 x 128 pixels and 64 frames.
import * as THREE from 'three';
$if FORMAT=exr$$if FLAT=yes$import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
$if FORMAT=exr$$if FLAT=no$import { EXR3DTextureLoader } from '@takram/three-geospatial';

const url = new URL('./$FILE$', import.meta.url).href;

// Returns a texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels.
export async function load() {
$if FORMAT=bin$    const response = await fetch(url);
$if FORMAT=bin$    if (!response.ok) throw new Error(`$FILE$: ${response.status}`);
$if FORMAT=bin$    const bytes = await response.arrayBuffer();
$if FORMAT=bin$$if TYPE=half$    const texels = new Uint16Array(bytes);
$if FORMAT=bin$$if TYPE=unorm8$    const texels = new Uint8Array(bytes);
$if FORMAT=bin$$if FLAT=yes$    const texture = new THREE.DataTexture(texels, $WIDTH$, $HEIGHT$);
$if FORMAT=bin$$if FLAT=no$    const texture = new THREE.Data3DTexture(texels, $WIDTH$, $HEIGHT$, $DEPTH$);
$if FORMAT=bin$$if CHANNELS=1$    texture.format = THREE.RedFormat;
$if FORMAT=bin$$if CHANNELS=2$    texture.format = THREE.RGFormat;
$if FORMAT=bin$$if CHANNELS=3$    texture.format = THREE.RGBFormat;
$if FORMAT=bin$$if CHANNELS=4$    texture.format = THREE.RGBAFormat;
$if FORMAT=bin$$if TYPE=half$    texture.type = THREE.HalfFloatType;
$if FORMAT=bin$    texture.unpackAlignment = 1;
$if FORMAT=exr$$if FLAT=yes$    const texture = await new EXRLoader().loadAsync(url);
$if FORMAT=exr$$if FLAT=no$    const loader = new EXR3DTextureLoader({ width: $WIDTH$, height: $HEIGHT$, depth: $DEPTH$ });
$if FORMAT=exr$$if FLAT=no$    const texture = await loader.loadAsync(url);
$if FORMAT=png$    const texture = await new THREE.TextureLoader().loadAsync(url);
$if FORMAT=png$$if KIND=noise_volume$    texture.flipY = false;
    texture.colorSpace = THREE.NoColorSpace;
$if KIND=noise_volume,weather_map,blue_noise$    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
$if KIND=noise_volume,blue_noise$$if DIM=3$$if FLAT=no$    texture.wrapR = THREE.RepeatWrapping;
$if KIND=weather_map$    texture.minFilter = THREE.LinearMipmapLinearFilter;
$if KIND=bruneton,noise_volume$    texture.minFilter = THREE.LinearFilter;
$if KIND=bruneton,noise_volume,weather_map$    texture.magFilter = THREE.LinearFilter;
$if KIND=blue_noise$    texture.minFilter = texture.magFilter = THREE.NearestFilter;
    texture.needsUpdate = true;
    return texture;
}
