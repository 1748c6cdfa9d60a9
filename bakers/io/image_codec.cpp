// What the module skybake_images exports.
#include "bakers/io/image_codec.h"

#include "bakers/io/map_reader.h"
#include "bakers/io/png_encoder.h"
#include "bakers/io/text_renderer.h"

extern "C" const skybake::ImageCodec* skybake_image_codec() {
    static constexpr skybake::ImageCodec codec = {skybake::read_map, skybake::encode_png,
                                                  skybake::draw_text};
    return &codec;
}
