// Loads $FILE$ into three.js with the wrapping and the filters that its lookups need: put both files
// beside each other and call `await load(renderer)`.
$if KIND=environment$// The texture is an equirectangular map of radiance: `scene.background = scene.environment = texture`.
$if KIND=environment$// The sun stands over +x.
$if FORMAT=ktx2$// `skybake info --lookup $FILE$` prints the GLSL that reads the texture.
import * as THREE from 'three';
$if FORMAT=ktx2$import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
$if FORMAT=exr$import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';

const wraps = { repeat: THREE.RepeatWrapping, clamp: THREE.ClampToEdgeWrapping };

// Returns a $WIDTH$ x $HEIGHT$ x $DEPTH$ texture of type $TYPE$.
$if FORMAT=ktx2$export async function load(renderer) {
$if FORMAT=ktx2$    const loader = new KTX2Loader().detectSupport(renderer);
$if FORMAT=exr$export async function load() {
$if FORMAT=exr$    const loader = new EXRLoader().setDataType(THREE.HalfFloatType);
    const texture = await loader.loadAsync(new URL('./$FILE$', import.meta.url).href);
$if FORMAT=ktx2$    loader.dispose();
$if KIND=environment$    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.colorSpace = THREE.NoColorSpace;
    texture.wrapS = wraps.$WRAP_U$;
    texture.wrapT = wraps.$WRAP_V$;
$if DIM=3$    texture.wrapR = wraps.$WRAP_W$;
$if FILTER=linear$    texture.magFilter = texture.minFilter = THREE.LinearFilter;
$if FILTER=nearest$    texture.magFilter = texture.minFilter = THREE.NearestFilter;
    if (texture.mipmaps.length > 1) texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
}
