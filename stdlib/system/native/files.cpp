// SPDX-License-Identifier: Apache-2.0
// Native bodies of files.st: each forwards its call to the host's files. Without such a host, opening is denied.
#include "rung/code.h"

namespace {

// Returns the value of the host's function; without files `otherwise`.
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

int64_t rung_system_HOST_FILE_BEGIN(rung_context* ctx, uint8_t kind, uint32_t flags, int64_t file, const char* name,
                                    const char* target, void* buffer, uint64_t count) {
  if (kind > RUNG_WORK_READ) return RUNG_FILE_FAILED;
  if (kind == RUNG_WORK_WRITE && (buffer == nullptr || count > RUNG_WORK_BYTES)) return RUNG_FILE_FAILED;
  const rung_files* const files = ctx->host == nullptr ? nullptr : ctx->host->files;
  if (files == nullptr || files->begin == nullptr) return RUNG_FILE_DENIED;
  const rung_file_work work = {kind, flags, file, name, target, buffer, count};
  return files->begin(ctx->host->files_data, &work);
}
int64_t rung_system_HOST_FILE_RESULT(rung_context* ctx, int64_t work, void* buffer, uint64_t capacity) {
  const rung_files* const files = ctx->host == nullptr ? nullptr : ctx->host->files;
  if (files == nullptr || files->result == nullptr) return RUNG_FILE_HANDLE;
  return files->result(ctx->host->files_data, work, buffer, buffer == nullptr ? 0 : capacity);
}

}  // extern "C"
