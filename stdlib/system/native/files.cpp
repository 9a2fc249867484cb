// Native bodies of files.st: each forwards its call to the host's files. Without such a host, opening is denied.
#include "rung/code.h"

namespace {

// What the host's function returns; without files `otherwise`.
template <class... Given, class... Wanted>
int64_t ask(const rung_context* ctx, int64_t otherwise, int64_t (*rung_files::*function)(void*, Wanted...),
            Given... given) {
  const rung_files* const files = ctx->host == nullptr ? nullptr : ctx->host->files;
  return files == nullptr ? otherwise : (files->*function)(ctx->host->files_data, given...);
}

}  // namespace

extern "C" {

int64_t rung_system_HOST_FILE_OPEN(rung_context* ctx, const char* name, uint32_t mode) {
  return ask(ctx, RUNG_FILE_DENIED, &rung_files::open, name, mode);
}
int64_t rung_system_HOST_FILE_CLOSE(rung_context* ctx, int64_t file) {
  return ask(ctx, RUNG_FILE_HANDLE, &rung_files::close, file);
}
int64_t rung_system_HOST_FILE_READ(rung_context* ctx, int64_t file, void* buffer, uint64_t count) {
  return buffer == nullptr ? int64_t{RUNG_FILE_HANDLE}
                           : ask(ctx, RUNG_FILE_HANDLE, &rung_files::read, file, buffer, count);
}
int64_t rung_system_HOST_FILE_WRITE(rung_context* ctx, int64_t file, void* buffer, uint64_t count) {
  return buffer == nullptr ? int64_t{RUNG_FILE_HANDLE}
                           : ask(ctx, RUNG_FILE_HANDLE, &rung_files::write, file, buffer, count);
}
int64_t rung_system_HOST_FILE_SEEK(rung_context* ctx, int64_t file, int64_t offset, int32_t from) {
  return ask(ctx, RUNG_FILE_HANDLE, &rung_files::seek, file, offset, from);
}
int64_t rung_system_HOST_FILE_RENAME(rung_context* ctx, const char* old_name, const char* new_name) {
  return ask(ctx, RUNG_FILE_DENIED, &rung_files::rename, old_name, new_name);
}
#define RUNG_OF_ONE_NAME(NAME, function)                                 \
  int64_t rung_system_HOST_##NAME(rung_context* ctx, const char* name) { \
    return ask(ctx, RUNG_FILE_DENIED, &rung_files::function, name);      \
  }
RUNG_OF_ONE_NAME(FILE_SIZE, size)
RUNG_OF_ONE_NAME(FILE_REMOVE, remove)
RUNG_OF_ONE_NAME(FOLDER_MAKE, make_folder)
RUNG_OF_ONE_NAME(FOLDER_REMOVE, remove_folder)
#undef RUNG_OF_ONE_NAME

}  // extern "C"
