// What the module skybake_images exports.
#include "bakers/io/formats/png/image_codec.h"

#include "bakers/io/formats/png/map_reader.h"
#include "bakers/io/formats/png/png_encoder.h"

extern "C" const skybake::ImageCodec* skybake_image_codec() {
    static constexpr skybake::ImageCodec codec = {skybake::read_map, skybake::encode_png};
    return &codec;
}
