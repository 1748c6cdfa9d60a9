// Lookups of asset = "flipbook". uv are texture coordinates of a frame, which repeats. frame is the number of a
// frame, counted from 0, and how far time is from it to the next: seconds times frames per second. Frames
// repeat, and two of them are blended. `frames` is how many there are.

// From a texture with a layer per frame. Use a sampler that filters and repeats along all axes.
// Cost: fetches 1, operations 2, divisions 0, special functions 0
vec4 flipbook(sampler3D table, float frames, vec2 uv, float frame) {
    return texture(table, vec3(uv, (frame + 0.5) / frames));
}

// From an array of 2-D textures, whose mips keep frames apart. Use a sampler that filters and repeats along u and
// v. If the frames are no loop, keep frame from 0 to the number of the last one.
// Cost: fetches 2, operations 25, divisions 0, special functions 0
vec4 flipbook_layers(sampler2DArray table, float frames, vec2 uv, float frame) {
    float low = floor(frame);
    float first = low - frames * floor((low + 0.5) / frames);
    float second = low + 1.0 - frames * floor((low + 1.5) / frames);
    vec4 before = texture(table, vec3(uv, first));
    vec4 after = texture(table, vec3(uv, second));
    return mix(before, after, frame - low);
}

// One frame of a sheet of cells.x columns and cells.y rows, which begins at the top left and goes on to the
// right, as Unreal's SubUV and Unity's texture sheets do. Texels are taken one by one, so that no filter mixes
// the edges of a frame with its neighbours on the sheet, which has so many texels as a whole.
vec4 flipbook_cell(sampler2D sheet, vec2 whole, vec2 uv, float frame, vec2 cells) {
    vec2 size = whole / cells;
    float row = floor((frame + 0.5) / cells.x);
    vec2 corner = size * vec2(frame - cells.x * row, row) + 0.5;
    vec2 at = uv * size - 0.5;
    vec2 low = floor(at);
    vec2 share = at - low;
    vec2 a = low - size * floor((low + 0.5) / size);
    vec2 b = low + 1.0 - size * floor((low + 1.5) / size);
    vec4 left = texture(sheet, (corner + a) / whole);
    vec4 right = texture(sheet, (corner + vec2(b.x, a.y)) / whole);
    vec4 lower_left = texture(sheet, (corner + vec2(a.x, b.y)) / whole);
    vec4 lower_right = texture(sheet, (corner + b) / whole);
    return mix(mix(left, right, share.x), mix(lower_left, lower_right, share.x), share.y);
}

// The same as flipbook, from a sheet. Cells beyond the last frame are not read.
vec4 flipbook_sheet(sampler2D sheet, vec2 whole, float frames, vec2 uv, float frame, vec2 cells) {
    float low = floor(frame);
    float first = low - frames * floor((low + 0.5) / frames);
    float second = low + 1.0 - frames * floor((low + 1.5) / frames);
    return mix(flipbook_cell(sheet, whole, uv, first, cells), flipbook_cell(sheet, whole, uv, second, cells),
               frame - low);
}
