#include "bakers/field/table_model.h"

#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"

namespace skybake {

double lookup_u(const TableModel& model, double x, int columns) {
    return texture_coordinate(model.convention, x, columns);
}

double lookup_v(const TableModel& model, double y, int rows) {
    return model.v_of ? model.v_of(y, rows) : texture_coordinate(model.convention, y, rows);
}

Image2<double> bake_texels(const TableModel& model, int level, std::array<int, 2> size,
                           const BakeOptions& options) {
    Image2<double> image(size[0], size[1], model.channels);
    std::vector<double> x;
    for (int i = 0; i < size[0]; ++i) x.push_back(texel_coordinate(model.convention, i, size[0]));
    for_each_tile(size[1], options, "texels", [&](int j) {
        model.row(level, texel_coordinate(model.convention, j, size[1]), x, image.texel(0, j));
    });
    return image;
}

Image2<float> store_texels(const Image2<double>& texels, PixelType type, RangeCounts& range) {
    Image2<float> image(texels.width, texels.height, texels.channels);
    for (std::size_t i = 0; i < texels.texels.size(); ++i) {
        image.texels[i] = store(texels.texels[i], type, range);
    }
    if (type == PixelType::rgbe) {
        round_values(image.texels.data(), image.texels.size(), type);
    }
    return image;
}

}  // namespace skybake
