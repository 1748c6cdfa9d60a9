#include "bakers/io/write_table.h"

#include <chrono>

#include "bakers/io/exr.h"
#include "bakers/io/hash.h"
#include "bakers/io/metadata.h"

namespace skybake {
namespace {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::string table_file_name(const std::string& name) { return name + ".exr"; }

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

config::Outcome<WriteResult> write_table(EncodedTable& table, const std::filesystem::path& folder,
                                         const Progress* progress) {
    AtomicFiles files;
    auto result = stage_table(table, folder, files, progress);
    if (!result.value) return result;
    std::vector<config::Diagnostic> diagnostics = files.commit();
    if (!diagnostics.empty()) return {{}, std::move(diagnostics)};
    return result;
}

}  // namespace skybake
