#include "bakers/io/formats/write_table.h"

#include "bakers/io/files/file_names.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/io/formats/exr/exr.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/math/hash.h"

namespace skybake {

config::Outcome<EncodedTable> encode_table(const BakedTable& table) {
    const Stopwatch stopwatch;
    EncodedTable encoded;
    encoded.asset = describe(table);
    ExrImage image{table.image, table.channel_names, table.pixel_type, table.compression,
                   exr_attributes(encoded.asset)};
    config::Outcome<std::string> bytes = encode_exr(image);
    const std::string file = table_file_name(table.name);
    for (config::Diagnostic& diagnostic : bytes.diagnostics) diagnostic.where.source = file;
    if (!bytes.value) return {{}, std::move(bytes.diagnostics)};
    encoded.bytes = std::move(*bytes.value);
    encoded.asset.files = {
        {file, "exr", table.pixel_type, encoded.bytes.size(), xxh3_hex(encoded.bytes)}};
    encoded.asset.timing.write_s = stopwatch.seconds();
    return {std::move(encoded), std::move(bytes.diagnostics)};
}

config::Outcome<WriteResult> stage_table(EncodedTable& table, const std::filesystem::path& folder,
                                         AtomicFiles& files, const Progress* progress) {
    const Stopwatch stopwatch;
    auto result = files.stage(folder / table_file_name(table.asset.name), table.bytes, progress);
    table.asset.timing.write_s += stopwatch.seconds();
    return result;
}

}  // namespace skybake
