#include "viewer/picture.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include "viewer/picture_module.hpp"

namespace relevo::viewer {

namespace fs = std::filesystem;

namespace {

std::string lower_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

// OpenImageIO and what it needs take 0.2 s to load, more than most commands run: so it comes by a module of
/// its own, which is loaded when there is a picture to write.
struct Writer {
    WritePicture write;
};
Result<Writer> load_writer() {
    void* module = nullptr;
    std::string reason;
    // Beside the program first: a moved installation finds its own module.
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    for (const fs::path& place :
         {program.parent_path().parent_path() / RELEVO_MODULE_FROM_PROGRAM / RELEVO_PICTURE_MODULE,
          fs::path(RELEVO_MODULE_FOLDER) / RELEVO_PICTURE_MODULE,
          fs::path(RELEVO_PICTURE_MODULE)}) {  // in the program's run path
        module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (module != nullptr) break;
        const char* text = dlerror();
        if (reason.empty() || fs::exists(place, failed)) reason = text != nullptr ? text : "unknown";
    }
    void* symbol = module != nullptr ? dlsym(module, kWritePictureName) : nullptr;
    if (symbol == nullptr) {
        return Error{
            ErrorKind::internal,
            fmt::format("pictures cannot be written: {} is not with the program ({}); install Relevo again",
                        RELEVO_PICTURE_MODULE, reason)};
    }
    return Writer{reinterpret_cast<WritePicture>(symbol)};
}

}  // namespace

Result<void> check_picture_name(const fs::path& file) {
    const std::string extension = lower_extension(file);
    for (const char* known : {".png", ".jpg", ".jpeg", ".tif", ".tiff"}) {
        if (extension == known) return {};
    }
    return Error{ErrorKind::usage,
                 fmt::format("{}: a picture's name ends in .png, .jpg or .tif", file.string())};
}

Result<void> write_picture(const Picture& picture, const fs::path& file, const PictureNotes& notes) {
    if (auto known = check_picture_name(file); !known) return known;
    const auto writer = load_writer();
    if (!writer) return writer.error();
    // Under a name of its own until it is whole; the extension says the format, so it stays last.
    fs::path unfinished = file;
    unfinished.replace_filename(
        fmt::format(".{}.{}{}", file.stem().string(), static_cast<long>(getpid()), lower_extension(file)));
    std::vector<const char*> texts;
    for (const auto& [key, value] : notes.texts) {
        texts.push_back(key.c_str());
        texts.push_back(value.c_str());
    }
    std::string reason(512, '\0');
    const bool written = writer->write(unfinished.c_str(), picture.width, picture.height, picture.rgb.data(),
                                       notes.description.c_str(), texts.data(), notes.texts.size(),
                                       reason.data(), reason.size());
    std::error_code failed;
    if (written) fs::rename(unfinished, file, failed);
    if (!written || failed) {
        reason.resize(reason.find('\0'));
        std::error_code ignored;
        fs::remove(unfinished, ignored);
        return Error{ErrorKind::internal, fmt::format("{}: cannot be written: {}", file.string(),
                                                      written ? failed.message() : reason)};
    }
    return {};
}

}  // namespace relevo::viewer
