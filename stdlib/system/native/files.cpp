// Native bodies of files.st: each forwards its call to the host's files. Without such a host, opening is denied.
#include "rung/code.h"

namespace {

const rung_files* filesOf(const rung_context* ctx) { return ctx->host == nullptr ? nullptr : ctx->host->files; }
void* dataOf(const rung_context* ctx) { return ctx->host->files_data; }

}  // namespace

extern "C" {

int64_t rung_system_HOST_FILE_OPEN(rung_context* ctx, const char* name, uint32_t mode) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->open(dataOf(ctx), name, mode);
}
int64_t rung_system_HOST_FILE_CLOSE(rung_context* ctx, int64_t file) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_HANDLE} : files->close(dataOf(ctx), file);
}
int64_t rung_system_HOST_FILE_READ(rung_context* ctx, int64_t file, void* buffer, uint64_t count) {
  const rung_files* const files = filesOf(ctx);
  if (files == nullptr || buffer == nullptr) return RUNG_FILE_HANDLE;
  return files->read(dataOf(ctx), file, buffer, count);
}
int64_t rung_system_HOST_FILE_WRITE(rung_context* ctx, int64_t file, void* buffer, uint64_t count) {
  const rung_files* const files = filesOf(ctx);
  if (files == nullptr || buffer == nullptr) return RUNG_FILE_HANDLE;
  return files->write(dataOf(ctx), file, buffer, count);
}
int64_t rung_system_HOST_FILE_SEEK(rung_context* ctx, int64_t file, int64_t offset, int32_t from) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_HANDLE} : files->seek(dataOf(ctx), file, offset, from);
}
int64_t rung_system_HOST_FILE_SIZE(rung_context* ctx, const char* name) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->size(dataOf(ctx), name);
}
int64_t rung_system_HOST_FILE_REMOVE(rung_context* ctx, const char* name) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->remove(dataOf(ctx), name);
}
int64_t rung_system_HOST_FILE_RENAME(rung_context* ctx, const char* old_name, const char* new_name) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->rename(dataOf(ctx), old_name, new_name);
}
int64_t rung_system_HOST_FOLDER_MAKE(rung_context* ctx, const char* name) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->make_folder(dataOf(ctx), name);
}
int64_t rung_system_HOST_FOLDER_REMOVE(rung_context* ctx, const char* name) {
  const rung_files* const files = filesOf(ctx);
  return files == nullptr ? int64_t{RUNG_FILE_DENIED} : files->remove_folder(dataOf(ctx), name);
}

}  // extern "C"
