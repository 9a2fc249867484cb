// SPDX-License-Identifier: Apache-2.0
// The inputs of a run; see inputs.h.
#include "tools/driver/inputs.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "frontend/import/pairs.h"
#include "frontend/import/twincat/twincat.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"
#include "frontend/syntax/diagnostics.h"
#include "tools/driver/diagnostics.h"
#include "tools/driver/file_provider.h"
#include "tools/driver/folder.h"
#include "tools/driver/libraries.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

class Collector {
 public:
  Collector(const ProjectOptions& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs)
      : options_(options), files_(options.unsaved), sources_(sources), diagnostics_(diagnostics), inputs_(inputs) {}

  void collect() {
    for (const std::string& word : options_.inputs) addInput(word);
    for (const std::string& written : options_.library_paths) addLibrary(libraryPath(written));
    for (const std::string& written : libraryPaths(inputs_.project)) addLibrary(libraryPath(written));
    if (inputs_.io_error) return;
    findRoot();
    for (Candidate& candidate : candidates_)
      candidate.below = fs::path(candidate.absolute).lexically_relative(inputs_.root).generic_string();
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.below != b.below ? a.below < b.below : a.named > b.named;
    });
    has_ladder_ = std::any_of(candidates_.begin(), candidates_.end(), [](const Candidate& candidate) {
      return importer::formatOf(importer::kindOfExtension(candidate.path)).has(importer::kHasControl);
    });
    const Candidate* last = nullptr;
    for (const Candidate& candidate : candidates_) {
      if (last == nullptr || last->below != candidate.below) addFile(candidate);
      last = &candidate;
    }
    addLibraryPrograms();
    if (inputs_.files.empty() && inputs_.message_files.empty() && !inputs_.io_error && !diagnostics_.hasErrors() &&
        !options_.inputs.empty())
      fail(diag::EmptyFolder, options_.inputs[0], {options_.inputs[0]});
  }

 private:
  struct Candidate {
    std::string absolute, path, below;
    bool named;  // on the command line, in rung.project, or a plc.xml; not one that a folder happens to have
    bool is_library = false;  // listed by a .plcproj given with -I
    uint32_t library = 0;     // index in Inputs::library_names
  };

  void fail(Diag diag, const std::string& path, std::initializer_list<std::string_view> args,
            std::string_view suggestion = {}) {
    diagnostics_.report(diag, {}, args).path(path).didYouMean(suggestion);
    inputs_.io_error = true;
  }

  // A name in the same folder similar to the missing one.
  std::string similar(const std::string& path) const {
    size_t slash = path.rfind('/');
    std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    const std::vector<std::string> names = namesIn(folder);
    std::vector<std::string_view> views(names.begin(), names.end());
    std::string_view near = nearest(std::string_view(path).substr(slash == std::string::npos ? 0 : slash + 1), views);
    if (near.empty()) return {};
    return (slash == std::string::npos ? "" : path.substr(0, slash + 1)) + std::string(near);
  }

  void addInput(const std::string& word) {
    struct stat info;
    if (files_.isUnsaved(word)) {
      addInputFile(word);
    } else if (stat(word.c_str(), &info) != 0) {
      const char* why = strerror(errno);
      fail(diag::CannotRead, word, {word, why}, similar(word));
    } else if (S_ISDIR(info.st_mode)) {
      bases_.push_back(absolutePath(word));
      addProjectFolder(word);
    } else if (!S_ISREG(info.st_mode)) {
      fail(diag::CannotRead, word, {word, "not a file or folder"});
    } else {
      addInputFile(word);
    }
  }

  void addInputFile(const std::string& path) {
    const FileRole role = importer::roleOf(importer::kindOfExtension(path));
    const std::string folder = folderOf(path);
    bases_.push_back(absolutePath(folder));
    if (role == FileRole::RungProject || role == FileRole::FolderProject) return addProjectFolder(folder);
    addNamedFile(path);
  }

  void addNamedFile(const std::string& path) {
    if (importer::roleOf(importer::kindOfExtension(path)) == FileRole::ListingProject) return addPlcProject(path);
    candidates_.push_back({absolutePath(path), path, {}, true});
  }

  // Tells whether a file of a library has a PROGRAM or a POU for implicit checks.
  bool mayBeInProjectToo(const std::string& path) const {
    if (!importer::hasExtension(path, ".tcpou")) return false;
    const std::string text = files_.read(path).content;
    const size_t begin = text.find("<![CDATA[");
    if (begin == std::string::npos) return false;
    const std::string word = firstWord(std::string_view(text).substr(begin + 9));
    return word == "PROGRAM" || (word == "FUNCTION" && upper(fs::path(path).stem().string()).starts_with("CHECK"));
  }

  // Tells whether a file that was read has a PROGRAM or FUNCTION of this name.
  bool declares(std::string_view name) const {
    for (const InputFile& input : inputs_.files) {
      Scanner scanner(sources_.original(input.file));
      bool is_name = false;
      for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
        const std::string word = upper(sources_.original(input.file).substr(unit.begin, unit.end - unit.begin));
        if (is_name && sameIdentifier(word, name)) return true;
        is_name = word == "PROGRAM" || word == "FUNCTION" || (is_name && (word == "INTERNAL" || word == "PUBLIC"));
      }
    }
    return false;
  }

  // Blocks of a library may call its programs; no task runs them. One that the project has too, such as MAIN, is there
  // for trying the library out, and functions such as CheckBounds are for the library as a project of its own.
  void addLibraryPrograms() {
    std::sort(library_programs_.begin(), library_programs_.end(),
              [](const Candidate& a, const Candidate& b) { return a.path < b.path; });
    for (Candidate& candidate : library_programs_) {
      const std::string stem = fs::path(candidate.path).stem().string();
      if (declares(stem)) continue;
      candidate.below = fs::path(candidate.absolute).lexically_relative(inputs_.root).generic_string();
      addFile(candidate);
    }
  }

  // The files listed by a TwinCAT project, relative to its folder. Tasks of a library are left out.
  void addPlcProject(const std::string& path, bool is_library = false) {
    ReadResult read = files_.read(path);
    if (!read.error.empty()) return fail(diag::CannotRead, path, {path, read.error});
    inputs_.read.push_back(path);
    const FileId file = sources_.add(path, std::move(read.content));
    if (!file) return fail(diag::TooMuchInput, path, {path});
    importer::twincat::Project project;
    if (!importer::twincat::readProject(sources_, file, diagnostics_, project)) return;
    const size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    inputs_.is_twincat = true;
    std::vector<std::string> names = std::move(project.names);
    names.insert(names.begin(), path.substr(folder.size(), path.rfind('.') - folder.size()));
    const auto library_index = static_cast<uint32_t>(inputs_.library_names.size());
    if (is_library)
      inputs_.library_names.push_back(std::move(names));
    else
      inputs_.project_names.insert(inputs_.project_names.end(), names.begin(), names.end());
    for (const importer::twincat::ProjectEntry& entry : project.files) {
      const std::string listed = sameFile(folder, entry.path);
      if (is_library && importer::hasExtension(entry.path, ".tctto")) continue;
      struct stat info;
      if (files_.isUnsaved(listed) || stat(listed.c_str(), &info) == 0) {
        std::vector<Candidate>& to = is_library && mayBeInProjectToo(listed) ? library_programs_ : candidates_;
        to.push_back({absolutePath(listed), listed, {}, true, is_library, library_index});
        continue;
      }
      const char* why = strerror(errno);
      diagnostics_.report(diag::CannotRead, entry.loc, {entry.path, why})
          .length(static_cast<uint32_t>(entry.path.size()));
      ++inputs_.missing_files;
    }
    for (importer::Library& library : project.libraries) inputs_.libraries.push_back(std::move(library));
  }

  // A library that is not in ST, which libraries.cpp reads: a file, or a folder whose files form one library and each
  // folder in it another.
  void addLibrary(const LibraryPath& library, bool with_folders = true) {
    const std::string& path = library.path;
    struct stat info;
    if (stat(path.c_str(), &info) != 0) return;  // libraries.cpp reports it
    if (importer::roleOf(importer::kindOfExtension(path)) == FileRole::ListingProject) return addPlcProject(path, true);
    if (S_ISREG(info.st_mode)) return addLibraryFile(path, library.name(), true);
    Folder folder;
    setScannedRoot(path);
    if (!list(path, folder)) return;
    for (const std::string& project : folder.plc_projects) addPlcProject(project, true);
    if (!folder.plc_projects.empty()) return;
    for (const std::string& file : folder.files) addLibraryFile(file, library.name(), false);
    if (!with_folders || folder.is_beremiz) return;
    for (const std::string& inner : folder.folders) addLibrary({{}, inner}, false);
  }

  void addLibraryFile(const std::string& path, const std::string& library, bool named) {
    if (isLibraryInSt(path) || importer::roleOf(importer::kindOfExtension(path)) == FileRole::Messages) return;
    SourceFile source;
    if (!read(path, path, named, source)) return;
    inputs_.library_files.push_back({path, library, source.kind, source.file});
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
    inputs_.folders.push_back(folder);
    const std::string file = prefixOf(folder) + "rung.project";
    struct stat info;
    const bool on_disk = stat(file.c_str(), &info) == 0 && S_ISREG(info.st_mode);
    if (!on_disk && !files_.isUnsaved(file)) return addFolder(folder);
    if (inputs_.project.file) {
      fail(diag::CannotRead, file, {file, "another folder of this run already has a rung.project"});
      return;
    }
    ReadResult read = files_.read(file);
    if (!read.error.empty()) return fail(diag::CannotRead, file, {file, read.error});
    inputs_.read.push_back(file);
    if (importer::isBinary(read.content)) return fail(diag::BinaryFile, file, {file});
    FileId id = sources_.add("rung.project", std::move(read.content));
    if (!id) return fail(diag::TooMuchInput, file, {file});
    inputs_.project.folder = folder;
    sources_.setDisplayPath(id, file);
    project_shown_ = file;
    parseProjectFile(sources_, id, diagnostics_, inputs_.project);
    if (inputs_.project.sources.empty()) return addFolder(folder);
    for (const std::string& source : inputs_.project.sources) {
      std::string path = source[0] == '/' ? source : prefixOf(folder) + source;
      struct stat entry;
      if (files_.isUnsaved(path)) {
        addNamedFile(path);
      } else if (stat(path.c_str(), &entry) != 0) {
        const char* why = strerror(errno);
        fail(diag::CannotRead, path, {path, why}, similar(path));
      } else if (S_ISDIR(entry.st_mode)) {
        addFolder(path);
      } else {
        addNamedFile(path);
      }
    }
  }

  void setScannedRoot(const std::string& folder) {
    std::error_code ignored;
    scanned_root_ = fs::canonical(folder, ignored).string();
  }

  void addFolder(const std::string& folder) {
    const size_t before = candidates_.size();
    setScannedRoot(folder);
    scan(folder, 0);
    const std::string prefix = prefixOf(folder);
    for (const std::string& below : files_.newFilesIn(folder))
      if (importer::holdsProgram(importer::kindOfExtension(below)))
        candidates_.push_back({absolutePath(prefix + below), prefix + below, {}, false});
    if (candidates_.size() == before && !diagnostics_.hasErrors()) fail(diag::EmptyFolder, folder, {folder});
  }

  // Reports links that lead out of the folder that is read; false: it cannot be read.
  bool list(const std::string& path, Folder& folder) {
    if (const std::string error = readFolder(path, scanned_root_, folder); !error.empty()) {
      fail(diag::CannotRead, path, {path, error});
      return false;
    }
    inputs_.read.push_back(path);
    for (const auto& [link, target] : folder.outside)
      diagnostics_.report(diag::LinkOutside, {}, {link, target}).path(link);
    return true;
  }

  // A folder with a .plcproj takes the files that it lists.
  void scan(const std::string& path, int depth, bool is_extension = false) {
    Folder folder;
    if (!list(path, folder)) return;
    if (is_extension) keepVariables(folder);
    for (const std::string& project : folder.plc_projects) addPlcProject(project);
    if (!folder.plc_projects.empty()) return;
    for (const std::string& file : folder.files)
      if (options_.written.empty() || absolutePath(file) != absolutePath(options_.written))
        candidates_.push_back({absolutePath(file), file, {}, folder.is_beremiz});
    if (depth > 100) return;
    for (const std::string& inner : folder.folders) scan(inner, depth + 1, is_extension || folder.is_beremiz);
  }

  void findRoot() {
    if (!options_.root.empty()) {
      inputs_.root = absolutePath(options_.root);
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

  struct SourceFile {
    FileKind kind = FileKind::Unknown;
    FileId file;
  };

  // Adds a file to the sources under a path; false: it holds no program, or an error was reported.
  bool read(const std::string& path, const std::string& under, bool named, SourceFile& source) {
    // Checked before reading: such a file would not fit the memory either.
    struct stat info;
    const auto failed = [&](Diag diag, std::initializer_list<std::string_view> args) {
      fail(diag, path, args);
      return false;
    };
    // A file of a folder that holds no text: the others are checked, without the names that it may have.
    const auto isNoText = [&](Diag diag) {
      if (named) return failed(diag, {path});
      diagnostics_.report(diag, {}, {path}).path(path);
      ++inputs_.missing_files;
      inputs_.unread = true;
      return false;
    };
    if (stat(path.c_str(), &info) == 0 && static_cast<uint64_t>(info.st_size) >= UINT32_MAX)
      return failed(diag::TooMuchInput, {path});
    ReadResult read = files_.read(path);
    if (!read.error.empty()) return failed(diag::CannotRead, {path, read.error});
    inputs_.read.push_back(path);
    if (!decodeUtf16(read.content)) return isNoText(diag::Utf16File);
    source.kind = importer::kindOf(path, read.content);
    if (source.kind == FileKind::Binary) return isNoText(diag::BinaryFile);
    if (source.kind == FileKind::Unknown) return failed(diag::UnknownFileKind, {path});
    if (importer::isProject(source.kind)) return false;
    if (!importer::holdsProgram(source.kind) && importer::roleOf(source.kind) != FileRole::Messages) {
      const std::string_view name = importer::formatOf(source.kind).name;
      if (named) return failed(diag::KindNotRead, {path, name});
      diagnostics_.report(diag::KindIgnored, {}, {path, name}).path(path);
      return false;
    }
    source.file = sources_.add(under, std::move(read.content));
    if (!source.file) return failed(diag::TooMuchInput, {path});
    sources_.setDisplayPath(source.file, path);
    return true;
  }

  void addFile(const Candidate& candidate) {
    SourceFile source;
    const bool holds_messages = importer::roleOf(importer::kindOfExtension(candidate.path)) == FileRole::Messages;
    if (holds_messages && !candidate.named && !has_ladder_) return;  // such a file may be anything
    if (!read(candidate.path, candidate.below, candidate.named, source)) return;
    std::vector<InputFile>& files =
        importer::roleOf(source.kind) == FileRole::Messages ? inputs_.message_files : inputs_.files;
    files.push_back({candidate.path, candidate.path, candidate.below, source.kind, source.file, candidate.is_library,
                     candidate.library});
  }

  const ProjectOptions& options_;
  const FileProvider files_;
  Sources& sources_;
  Diagnostics& diagnostics_;
  Inputs& inputs_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> library_programs_;
  std::vector<std::string> bases_;  // folders of the inputs, absolute
  std::string scanned_root_;        // of the folder that is read, without links
  std::string project_shown_;
  bool has_ladder_ = false;  // among the candidates
};

}  // namespace

void readInputs(const ProjectOptions& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs) {
  Collector(options, sources, diagnostics, inputs).collect();
}

// A product may have an area of such a letter itself, and then knows why.
static void addNctAreas(types::MemoryAreas& areas) {
  for (const types::MemoryArea& area : types::nctAreas())
    if (!types::findArea(areas, area.letter)) areas.push_back(area);
}

void readPrograms(Sources& sources, Diagnostics& diagnostics, Inputs& inputs, bool for_pictures) {
  std::vector<importer::PairCandidate> halves;
  for (const InputFile& input : inputs.files)
    if (importer::formatOf(input.kind).has(importer::kHasHalves)) halves.push_back({input.below, input.file});
  importer::joinPairs(sources, halves);
  if (!importer::joinMembers(sources, halves, diagnostics)) inputs.unread = true;
  auto half = halves.begin();
  for (InputFile& input : inputs.files)
    if (importer::formatOf(input.kind).has(importer::kHasHalves)) input.file = (half++)->file;
  std::erase_if(inputs.files, [](const InputFile& input) { return !input.file; });

  importer::ReadContext context{sources, diagnostics, inputs.libraries, inputs.project.ladder, for_pictures};
  for (const InputFile& input : inputs.message_files) context.message_files.push_back(input.file);
  const auto is_nct = [](const InputFile& input) { return importer::formatOf(input.kind).has(importer::kHasControl); };
  const std::vector<ProjectSection>& sections = inputs.project.sections;
  const auto is_about_control = [](const ProjectSection& section) { return section.kind == "nct"; };
  if (std::any_of(inputs.files.begin(), inputs.files.end(), is_nct) ||
      std::any_of(sections.begin(), sections.end(), is_about_control))
    addNctAreas(inputs.project.areas);
  FileId ladder;
  for (InputFile& input : inputs.files) {
    const importer::Format& format = importer::formatOf(input.kind);
    if (format.read == nullptr) continue;
    if (is_nct(input) && ladder) {
      diagnostics.report(diag::SecondLadder, sources.begin(input.file), {}).declaredHere(sources.begin(ladder));
      input.file = {};
      inputs.unread = true;
      continue;
    }
    if (is_nct(input)) {
      ladder = input.file;
      inputs.has_ladder = true;
    }
    input.file = format.read(context, input.file);
    if (!input.file) inputs.unread = true;
  }
  inputs.messages = std::move(context.messages);
  std::erase_if(inputs.files, [](const InputFile& input) { return !input.file; });
  for (LibraryInput& input : inputs.library_files) {
    const importer::Format& format = importer::formatOf(input.kind);
    if (format.read != nullptr) input.file = format.read(context, input.file);
  }
  std::erase_if(inputs.library_files, [](const LibraryInput& input) { return !input.file; });
}

}  // namespace rung::driver
