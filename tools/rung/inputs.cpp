// The inputs of a run; see inputs.h.
#include "tools/rung/inputs.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "frontend/import/iec10/iec10.h"
#include "frontend/import/plcopen/plcopen.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagnostics.h"
#include "tools/rung/diagnostics.h"

namespace rung::tool {
namespace {

namespace fs = std::filesystem;

bool hasExtension(std::string_view path, std::string_view extension) {
  if (path.size() <= extension.size()) return false;
  std::string_view end = path.substr(path.size() - extension.size());
  for (size_t i = 0; i < end.size(); i++) {
    char c = end[i] >= 'A' && end[i] <= 'Z' ? static_cast<char>(end[i] + 32) : end[i];
    if (c != extension[i]) return false;
  }
  return true;
}

struct Extension {
  const char* extension;
  FileKind kind;
};
constexpr Extension kExtensions[] = {{".st", FileKind::St},
                                     {".iecst", FileKind::St},
                                     {".pou", FileKind::St},
                                     {".decl", FileKind::St},
                                     {".impl", FileKind::St},
                                     {".exp", FileKind::Codesys2},
                                     {".tcpou", FileKind::TwinCat},
                                     {".tcdut", FileKind::TwinCat},
                                     {".tcgvl", FileKind::TwinCat},
                                     {".tcio", FileKind::TwinCat},
                                     {".tctleo", FileKind::TwinCat},
                                     {".tctto", FileKind::TwinCat},
                                     {".plcproj", FileKind::PlcProject},
                                     {".il", FileKind::Il},
                                     {".xml", FileKind::Xml},
                                     {".cfc", FileKind::Xml},
                                     {".nct", FileKind::Nct},
                                     {".cam", FileKind::Cam}};

FileKind kindOfExtension(std::string_view path) {
  if (path == "rung.project" || path.ends_with("/rung.project")) return FileKind::Project;
  for (const Extension& row : kExtensions)
    if (hasExtension(path, row.extension)) return row.kind;
  return FileKind::Unknown;
}

// True when a fifth of the first bytes is control characters or not UTF-8, or for a NUL: not a source in any encoding
// that editors of PLC code write.
bool isBinary(std::string_view text) {
  std::string_view head = text.substr(0, 4096);
  if (head.find('\0') != std::string_view::npos) return true;
  size_t bad = 0;
  for (size_t i = 0; i < head.size(); i++) {
    unsigned char c = static_cast<unsigned char>(head[i]);
    if (c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v' && c != 0x1a) bad++;
    if (c < 0x80) continue;
    size_t follow = c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
    size_t continued = 0;
    while (continued < follow && i + continued + 1 < head.size() && (head[i + continued + 1] & 0xc0) == 0x80)
      continued++;
    if (follow == 0 || continued < follow) bad++;
    i += continued;
  }
  return bad * 5 > head.size();
}

bool startsDeclaration(std::string_view text) {
  static constexpr const char* kKeywords[] = {"PROGRAM",   "FUNCTION",      "FUNCTION_BLOCK", "TYPE",
                                              "INTERFACE", "CONFIGURATION", "VAR_GLOBAL",     "NAMESPACE"};
  const std::string word = vendor::firstWord(text);
  for (const char* known : kKeywords)
    if (word == known) return true;
  return false;
}

vendor::Format formatOf(FileKind kind) {
  return kind == FileKind::TwinCat     ? vendor::Format::TwinCat
         : kind == FileKind::Codesys2  ? vendor::Format::Codesys2
         : kind == FileKind::Multiprog ? vendor::Format::Multiprog
                                       : vendor::Format::None;
}

const char* describe(FileKind kind) {
  switch (kind) {
    case FileKind::Xml: return "XML other than PLCopen's or that of IEC 61131-10";
    case FileKind::Nct: return "machine-tool ladder";
    case FileKind::Cam: return "a cam table";
    case FileKind::Unknown:
    case FileKind::St:
    case FileKind::Il:
    case FileKind::TwinCat:
    case FileKind::PlcProject:
    case FileKind::Plcopen:
    case FileKind::Iec10:
    case FileKind::Codesys2:
    case FileKind::Multiprog:
    case FileKind::Project:
    case FileKind::Binary: break;
  }
  return "a file of another kind";
}

class Collector {
 public:
  Collector(const Options& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs)
      : options_(options), sources_(sources), diagnostics_(diagnostics), inputs_(inputs) {}

  void collect() {
    for (const std::string& word : options_.inputs) addInput(word);
    for (const std::string& library : options_.library_paths)
      if (kindOfExtension(library) == FileKind::PlcProject) addPlcProject(library, true);
    if (inputs_.io_error) return;
    findRoot();
    for (Candidate& candidate : candidates_)
      candidate.below = fs::path(candidate.absolute).lexically_relative(inputs_.root).generic_string();
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.below != b.below ? a.below < b.below : a.named > b.named;
    });
    const Candidate* last = nullptr;
    for (const Candidate& candidate : candidates_) {
      if (last == nullptr || last->below != candidate.below) addFile(candidate);
      last = &candidate;
    }
    if (inputs_.files.empty() && !inputs_.io_error && !diagnostics_.hasErrors() && !options_.inputs.empty())
      fail(diag::EmptyFolder, options_.inputs[0], {options_.inputs[0]});
  }

 private:
  struct Candidate {
    std::string absolute, path, below;
    bool named;  // on the command line or in rung.project, not found in a folder
  };

  void fail(Diag diag, const std::string& path, std::initializer_list<std::string_view> args,
            std::string_view suggestion = {}) {
    diagnostics_.report(diag, {}, args).path(path).didYouMean(suggestion);
    inputs_.io_error = true;
  }

  static std::string absolute(const std::string& path) {
    std::error_code error;
    fs::path full = fs::absolute(path, error);
    std::string normal = (error ? fs::path(path) : full).lexically_normal().generic_string();
    while (normal.size() > 1 && normal.back() == '/') normal.pop_back();
    return normal;
  }

  // A name in the same folder similar to the missing one.
  std::string similar(const std::string& path) const {
    size_t slash = path.rfind('/');
    std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    std::vector<std::string> names;
    if (DIR* dir = opendir(folder.c_str())) {
      while (const dirent* entry = readdir(dir))
        if (entry->d_name[0] != '.') names.push_back(entry->d_name);
      closedir(dir);
    }
    std::sort(names.begin(), names.end());
    std::vector<std::string_view> views(names.begin(), names.end());
    std::string_view near = nearest(std::string_view(path).substr(slash == std::string::npos ? 0 : slash + 1), views);
    if (near.empty()) return {};
    return (slash == std::string::npos ? "" : path.substr(0, slash + 1)) + std::string(near);
  }

  void addInput(const std::string& word) {
    struct stat info;
    if (stat(word.c_str(), &info) != 0) {
      const char* why = strerror(errno);
      fail(diag::CannotRead, word, {word, why}, similar(word));
    } else if (S_ISDIR(info.st_mode)) {
      bases_.push_back(absolute(word));
      addProjectFolder(word);
    } else if (!S_ISREG(info.st_mode)) {
      fail(diag::CannotRead, word, {word, "not a file or folder"});
    } else if (kindOfExtension(word) == FileKind::Project) {
      size_t slash = word.rfind('/');
      std::string folder = slash == std::string::npos ? "." : word.substr(0, slash);
      bases_.push_back(absolute(folder));
      addProjectFolder(folder);
    } else {
      bases_.push_back(absolute(word.find('/') == std::string::npos ? "." : word.substr(0, word.rfind('/') + 1)));
      addNamedFile(word);
    }
  }

  void addNamedFile(const std::string& path) {
    if (kindOfExtension(path) == FileKind::PlcProject) return addPlcProject(path);
    candidates_.push_back({absolute(path), path, {}, true});
  }

  // A PROGRAM of a library is there for trying it out.
  static bool holdsProgram(const std::string& path) {
    if (!hasExtension(path, ".tcpou")) return false;
    const std::string text = readFile(path).content;
    const size_t begin = text.find("<![CDATA[");
    return begin != std::string::npos && vendor::firstWord(std::string_view(text).substr(begin + 9)) == "PROGRAM";
  }

  // The files listed by a TwinCAT project, relative to its folder. Tasks and programs of a library are left out.
  void addPlcProject(const std::string& path, bool is_library = false) {
    ReadResult read = readFile(path);
    if (!read.error.empty()) return fail(diag::CannotRead, path, {path, read.error});
    inputs_.read.push_back(path);
    const FileId file = sources_.add(path, std::move(read.content));
    if (!file) return fail(diag::TooMuchInput, path, {path});
    vendor::Project project;
    if (!vendor::readProject(sources_, file, diagnostics_, project)) return;
    const size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    inputs_.project_names.push_back(path.substr(folder.size(), path.rfind('.') - folder.size()));
    for (const vendor::ProjectEntry& entry : project.files) {
      const std::string listed = sameFile(folder, entry.name);
      if (is_library && (hasExtension(entry.name, ".tctto") || holdsProgram(listed))) continue;
      struct stat info;
      if (stat(listed.c_str(), &info) == 0) {
        candidates_.push_back({absolute(listed), listed, {}, true});
        continue;
      }
      const char* why = strerror(errno);
      diagnostics_.report(diag::CannotRead, entry.loc, {entry.name, why})
          .length(static_cast<uint32_t>(entry.name.size()));
      inputs_.io_error = true;
    }
    for (vendor::ProjectEntry& library : project.libraries) inputs_.libraries.push_back(std::move(library));
  }

  // `path` below the folder, in the letter case on disk: project files may come from case-insensitive systems.
  static std::string sameFile(const std::string& folder, const std::string& path) {
    struct stat info;
    if (stat((folder + path).c_str(), &info) == 0) return folder + path;
    std::string found = folder;
    for (size_t begin = 0; begin <= path.size();) {
      const size_t slash = std::min(path.find('/', begin), path.size());
      const std::string part = path.substr(begin, slash - begin);
      std::string match = part;
      if (DIR* dir = opendir(found.empty() ? "." : found.c_str())) {
        while (const dirent* entry = readdir(dir))
          if (sameIdentifier(entry->d_name, part)) match = entry->d_name;
        closedir(dir);
      }
      found += match;
      if (slash < path.size()) found += '/';
      begin = slash + 1;
    }
    return found;
  }

  void addProjectFolder(const std::string& folder) {
    const std::string file = (folder.back() == '/' ? folder : folder + "/") + "rung.project";
    struct stat info;
    if (stat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return addFolder(folder);
    if (inputs_.project.file) {
      fail(diag::CannotRead, file, {file, "another folder of this run already has a rung.project"});
      return;
    }
    ReadResult read = readFile(file);
    if (!read.error.empty()) return fail(diag::CannotRead, file, {file, read.error});
    inputs_.read.push_back(file);
    if (isBinary(read.content)) return fail(diag::BinaryFile, file, {file});
    FileId id = sources_.add("rung.project", std::move(read.content));
    if (!id) return fail(diag::TooMuchInput, file, {file});
    inputs_.project.folder = folder;
    sources_.setDisplayPath(id, folder + "/rung.project");
    project_shown_ = file;
    parseProjectFile(sources_, id, diagnostics_, inputs_.project);
    if (inputs_.project.sources.empty()) return addFolder(folder);
    for (const std::string& source : inputs_.project.sources) {
      std::string path = source[0] == '/' ? source : (folder.back() == '/' ? folder : folder + "/") + source;
      struct stat entry;
      if (stat(path.c_str(), &entry) != 0) {
        const char* why = strerror(errno);
        fail(diag::CannotRead, path, {path, why}, similar(path));
      } else if (S_ISDIR(entry.st_mode)) {
        addFolder(path);
      } else {
        addNamedFile(path);
      }
    }
  }

  // Hidden entries and links to folders are skipped: loops and `.git` do not belong to a project.
  void addFolder(const std::string& folder) {
    const size_t before = candidates_.size();
    inputs_.read.push_back(folder);
    scan(folder, 0);
    if (candidates_.size() == before && !diagnostics_.hasErrors()) fail(diag::EmptyFolder, folder, {folder});
  }

  // A folder with a .plcproj takes the files that it lists.
  void scan(const std::string& folder, int depth) {
    DIR* dir = opendir(folder.c_str());
    if (dir == nullptr) {
      const char* why = strerror(errno);
      return fail(diag::CannotRead, folder, {folder, why});
    }
    const size_t before = candidates_.size();
    std::vector<std::string> folders, projects;
    const std::string prefix = folder.back() == '/' ? folder : folder + "/";
    while (const dirent* entry = readdir(dir)) {
      if (entry->d_name[0] == '.') continue;
      std::string path = prefix + entry->d_name;
      unsigned char type = entry->d_type;
      if (type == DT_UNKNOWN || type == DT_LNK) {
        struct stat info;
        if (stat(path.c_str(), &info) != 0) continue;  // a dangling link
        if (S_ISREG(info.st_mode))
          type = DT_REG;
        else if (S_ISDIR(info.st_mode) && type == DT_UNKNOWN)
          type = DT_DIR;
      }
      if (type == DT_DIR) {
        folders.push_back(std::move(path));
      } else if (type == DT_REG) {
        FileKind kind = kindOfExtension(path);
        if (kind == FileKind::Unknown || kind == FileKind::Project) continue;
        if (kind == FileKind::PlcProject) {
          projects.push_back(std::move(path));
          continue;
        }
        candidates_.push_back({absolute(path), std::move(path), {}, false});
      }
    }
    closedir(dir);
    if (!projects.empty()) {
      candidates_.resize(before);
      std::sort(projects.begin(), projects.end());
      for (const std::string& project : projects) addPlcProject(project);
      return;
    }
    for (const std::string& inner : folders) {
      if (depth > 100) continue;
      inputs_.read.push_back(inner);
      scan(inner, depth + 1);
    }
  }

  void findRoot() {
    if (!options_.root.empty()) {
      inputs_.root = absolute(options_.root);
      struct stat info;
      if (stat(inputs_.root.c_str(), &info) != 0 || !S_ISDIR(info.st_mode))
        fail(diag::CannotRead, options_.root, {options_.root, "`--root` needs a folder"});
      return;
    }
    if (bases_.empty()) return;
    std::string root = bases_[0];
    for (const std::string& base : bases_) {
      while (base != root && !base.starts_with(root == "/" ? root : root + "/")) {
        size_t slash = root.rfind('/');
        root = slash == 0 || slash == std::string::npos ? "/" : root.substr(0, slash);
      }
    }
    inputs_.root = root;
  }

  void addFile(const Candidate& candidate) {
    // Checked before reading: such a file would not fit the memory either.
    struct stat info;
    if (stat(candidate.path.c_str(), &info) == 0 && static_cast<uint64_t>(info.st_size) >= UINT32_MAX)
      return fail(diag::TooMuchInput, candidate.path, {candidate.path});
    ReadResult read = readFile(candidate.path);
    if (!read.error.empty()) return fail(diag::CannotRead, candidate.path, {candidate.path, read.error});
    inputs_.read.push_back(candidate.path);
    if (!decodeUtf16(read.content)) return fail(diag::Utf16File, candidate.path, {candidate.path});
    FileKind kind = kindOf(candidate.path, read.content);
    switch (kind) {
      case FileKind::St:
      case FileKind::Il:
      case FileKind::TwinCat:
      case FileKind::Plcopen:
      case FileKind::Iec10:
      case FileKind::Codesys2:
      case FileKind::Multiprog: break;
      case FileKind::Binary: return fail(diag::BinaryFile, candidate.path, {candidate.path});
      case FileKind::Unknown: return fail(diag::UnknownFileKind, candidate.path, {candidate.path});
      case FileKind::Xml:
      case FileKind::Nct:
      case FileKind::Cam:
        if (candidate.named) return fail(diag::KindNotRead, candidate.path, {candidate.path, describe(kind)});
        diagnostics_.report(diag::KindIgnored, {}, {candidate.path, describe(kind)}).path(candidate.path);
        return;
      case FileKind::PlcProject:
      case FileKind::Project: return;
    }
    FileId file = sources_.add(candidate.below, std::move(read.content));
    if (!file) return fail(diag::TooMuchInput, candidate.path, {candidate.path});
    sources_.setDisplayPath(file, candidate.path);
    inputs_.files.push_back({candidate.path, candidate.path, candidate.below, kind, file});
  }

  const Options& options_;
  Sources& sources_;
  Diagnostics& diagnostics_;
  Inputs& inputs_;
  std::vector<Candidate> candidates_;
  std::vector<std::string> bases_;  // folders of the inputs, absolute
  std::string project_shown_;
};

// ---- POUs in two files

// When one of two files with equal names begins a POU and the other has no declaration, they are the POU and its body.
void joinPairs(Sources& sources, std::vector<InputFile>& files) {
  std::vector<std::pair<std::string, size_t>> bodies, declarations;
  for (size_t i = 0; i < files.size(); i++) {
    if (files[i].kind != FileKind::St) continue;
    const std::string_view text = sources.sourceText(files[i].file);
    const std::string word = vendor::firstWord(text);
    if (word == "PROGRAM" || word == "FUNCTION" || word == "FUNCTION_BLOCK")
      declarations.emplace_back(vendor::pairName(files[i].below), i);
    else if (!startsDeclaration(text))
      bodies.emplace_back(vendor::pairName(files[i].below), i);
  }
  std::sort(bodies.begin(), bodies.end());
  std::sort(declarations.begin(), declarations.end());
  for (size_t i = 0; i < bodies.size(); i++) {
    const std::string& name = bodies[i].first;
    if ((i > 0 && bodies[i - 1].first == name) || (i + 1 < bodies.size() && bodies[i + 1].first == name)) continue;
    const auto from = std::lower_bound(declarations.begin(), declarations.end(), std::pair{name, size_t{0}});
    if (from == declarations.end() || from->first != name) continue;
    if (from + 1 != declarations.end() && (from + 1)->first == name) continue;
    InputFile& declaration = files[from->second];
    declaration.file = vendor::joinPair(sources, declaration.file, files[bodies[i].second].file);
    files[bodies[i].second].file = {};
  }
  std::erase_if(files, [](const InputFile& file) { return !file.file; });
}

}  // namespace

FileKind kindOf(std::string_view path, std::string_view text) {
  FileKind by_name = kindOfExtension(path);
  if (isBinary(text)) return FileKind::Binary;
  switch (vendor::formatOf(text)) {
    case vendor::Format::TwinCat: return FileKind::TwinCat;
    case vendor::Format::TwinCatProject: return FileKind::PlcProject;
    case vendor::Format::Codesys2: return FileKind::Codesys2;
    case vendor::Format::Multiprog: return FileKind::Multiprog;
    case vendor::Format::None: break;
  }
  std::string_view start = text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
  size_t first = start.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && start.substr(first).starts_with("<") && plcopen::isPlcopen(start))
    return FileKind::Plcopen;
  if (first != std::string_view::npos && start.substr(first).starts_with("<") && iec10::isIec10(start))
    return FileKind::Iec10;
  if (first != std::string_view::npos && start.substr(first).starts_with("<") && by_name != FileKind::St)
    return FileKind::Xml;
  if (by_name == FileKind::Unknown && startsDeclaration(text)) return FileKind::St;
  // The extension claims XML, the content is not.
  if (by_name == FileKind::Xml || by_name == FileKind::TwinCat || by_name == FileKind::PlcProject)
    return FileKind::Unknown;
  if (by_name == FileKind::Codesys2) return FileKind::St;  // an export without its comments
  return by_name;
}

void readInputs(const Options& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs) {
  Collector(options, sources, diagnostics, inputs).collect();
}

void readPrograms(Sources& sources, Diagnostics& diagnostics, Inputs& inputs) {
  joinPairs(sources, inputs.files);
  std::vector<plcopen::Library> xml_libraries;
  for (InputFile& input : inputs.files) {
    const vendor::Format format = formatOf(input.kind);
    if (input.kind == FileKind::Plcopen)
      input.file = plcopen::readProject(sources, input.file, diagnostics, xml_libraries);
    else if (input.kind == FileKind::Iec10)
      input.file = iec10::readProject(sources, input.file, diagnostics);
    else if (format != vendor::Format::None)
      input.file = vendor::readProgram(sources, input.file, format, diagnostics);
    else
      continue;
    if (!input.file) inputs.unread = true;
  }
  for (plcopen::Library& library : xml_libraries)
    inputs.libraries.push_back({std::move(library.name), std::move(library.space), library.loc});
  std::erase_if(inputs.files, [](const InputFile& input) { return !input.file; });
}

}  // namespace rung::tool
