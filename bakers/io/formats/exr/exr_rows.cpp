#include "bakers/io/formats/exr/exr_rows.h"

#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "bakers/io/files/file_input.h"
#include "bakers/io/formats/exr/exr_library.h"

namespace skybake {
namespace {

class InputStream : public Imf::IStream {
  public:
    InputStream(const std::string& name, FileInput file)
        : Imf::IStream(name.c_str()), file_(std::move(file)) {}
    bool read(char out[], int count) override {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        const auto done = file_.read(position_, out, wanted);
        if (!done) {
            failed_ = true;
            throw std::runtime_error("it cannot be read");
        }
        if (*done < wanted) throw std::runtime_error("it ends early");
        position_ += wanted;
        return position_ < file_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }
    std::uint64_t size() const { return file_.size(); }
    // Why the file could not be read, where the system had a reason.
    std::optional<config::Diagnostic> failure() const {
        return failed_ ? std::optional(file_.diagnostic()) : std::nullopt;
    }

  private:
    FileInput file_;
    std::uint64_t position_ = 0;
    bool failed_ = false;
};

}  // namespace

struct ExrRows::File {
    File(std::string name_, FileInput input)
        : name(std::move(name_)), stream(name, std::move(input)) {}

    config::Diagnostic diagnostic(const std::string& reason) const {
        if (auto failure = stream.failure()) return *failure;
        return damaged_exr(name, reason);
    }

    std::string name;
    InputStream stream;
    std::unique_ptr<Imf::InputFile> image;
    ExrFacts facts;
};

ExrRows::ExrRows(std::unique_ptr<File> file) : file_(std::move(file)) {}
ExrRows::ExrRows(ExrRows&&) noexcept = default;
ExrRows& ExrRows::operator=(ExrRows&&) noexcept = default;
ExrRows::~ExrRows() = default;

int ExrRows::width() const { return file_->facts.width; }
int ExrRows::height() const { return file_->facts.height; }
const std::vector<std::string>& ExrRows::channel_names() const {
    return file_->facts.channel_names;
}
config::PixelType ExrRows::pixel_type() const { return file_->facts.pixel_type; }
config::Compression ExrRows::compression() const { return file_->facts.compression; }
const Attributes& ExrRows::attributes() const { return file_->facts.attributes; }

config::Outcome<ExrRows> ExrRows::open(const std::filesystem::path& path) {
    config::Outcome<FileInput> input = FileInput::open(path);
    if (!input.value) return {{}, std::move(input.diagnostics)};
    if (input.value->size() == 0) return {{}, {damaged_exr(path.string(), "it is empty")}};
    auto file = std::make_unique<File>(path.string(), std::move(*input.value));
    try {
        if (const auto reason = unreadable_header(file->stream, file->stream.size())) {
            return {{}, {damaged_exr(file->name, *reason)}};
        }
        file->image = std::make_unique<Imf::InputFile>(file->stream, 0);  // 0: no further threads
        file->facts = facts_of(file->image->header());
    } catch (const std::exception& error) {
        return {{}, {file->diagnostic(error.what())}};
    }
    return {ExrRows(std::move(file)), {}};
}

std::optional<config::Diagnostic> ExrRows::read(int first, int count, float* texels) {
    try {
        const Imath::Box2i window = file_->image->header().dataWindow();
        const std::size_t texel = sizeof(float) * channel_names().size();
        const std::size_t row = texel * static_cast<std::size_t>(width());
        const Imath::V2i origin(window.min.x, window.min.y + first);
        Imf::FrameBuffer buffer;
        for (std::size_t channel = 0; channel < channel_names().size(); ++channel) {
            buffer.insert(
                channel_names()[channel],
                Imf::Slice::Make(Imf::FLOAT, texels + channel, origin, width(), count, texel, row));
        }
        file_->image->setFrameBuffer(buffer);
        file_->image->readPixels(origin.y, origin.y + count - 1);
    } catch (const std::exception& error) {
        return file_->diagnostic(error.what());
    }
    return std::nullopt;
}

int ExrRows::rows_per_piece() const {
    constexpr std::size_t floats = std::size_t{1} << 20;
    constexpr std::size_t block = 32;  // rows that the widest codec has to unpack together
    const std::size_t row = static_cast<std::size_t>(width()) * channel_names().size();
    const std::size_t rows = std::max<std::size_t>(1, floats / row / block) * block;
    return static_cast<int>(std::min<std::size_t>(rows, static_cast<std::size_t>(height())));
}

}  // namespace skybake
