// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

namespace lvcalib::widgets {

/// What the readers of target.yaml and camera.yaml, and the search for pairs of files, say; see
/// kCorePatterns.
inline constexpr const char* kFilePatterns[] = {
    // Any YAML file.
    QT_TRANSLATE_NOOP("Core", "key '%1' is missing; expected %2"),
    QT_TRANSLATE_NOOP("Core", "is '%1' a misspelling of it?"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be between %2 and %3, found %4"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be at least %2, found %3"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be at most %2, found %3"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be a number, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be a whole number, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be a word, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be a map, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must be a list of numbers, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must hold numbers, found %2"),
    QT_TRANSLATE_NOOP("Core", "'%1' must hold %2 numbers, found %3"),
    QT_TRANSLATE_NOOP("Core", "%1: unknown key '%2' ignored; did you mean '%3'?"),
    QT_TRANSLATE_NOOP("Core", "%1: unknown key '%2' ignored"),
    QT_TRANSLATE_NOOP("Core", "not valid YAML: %1"),
    QT_TRANSLATE_NOOP("Core", "expected a YAML map of keys and values, found %1"),
    QT_TRANSLATE_NOOP("Core", "a number"),
    QT_TRANSLATE_NOOP("Core", "a word"),
    QT_TRANSLATE_NOOP("Core", "a map"),
    QT_TRANSLATE_NOOP("Core", "a list of numbers"),
    QT_TRANSLATE_NOOP("Core", "a list of %1"),
    QT_TRANSLATE_NOOP("Core", "a 3 × 3 matrix"),
    QT_TRANSLATE_NOOP("Core", "nothing"),
    // target.yaml.
    QT_TRANSLATE_NOOP("Core",
                      "target_type '%1' is not known; expected aprilgrid_circles, aprilgrid, "
                      "checkerboard, charuco or apriltag"),
    QT_TRANSLATE_NOOP("Core", "a checkerboard needs at least 3 × 3 inner corners"),
    QT_TRANSLATE_NOOP("Core", "square sizes must be positive"),
    QT_TRANSLATE_NOOP("Core", "the board outline is smaller than its pattern"),
    QT_TRANSLATE_NOOP("Core", "measure boardWidth and boardHeight"),
    QT_TRANSLATE_NOOP("Core", "marker ids %1 to %2 do not exist in %3, which has %4"),
    QT_TRANSLATE_NOOP("Core", "tag ids %1 to %2 do not exist in %3, which has %4"),
    QT_TRANSLATE_NOOP("Core", "the board is larger than 100 m"),
    QT_TRANSLATE_NOOP("Core", "spacings and outline are in metres"),
    QT_TRANSLATE_NOOP("Core", "the pattern reaches beyond the board's outline"),
    QT_TRANSLATE_NOOP("Core", "measure boardWidth, boardHeight and boardOffset"),
    QT_TRANSLATE_NOOP("Core",
                      "dictionary '%1' is not known; expected one of OpenCV's, DICT_4X4_50 to "
                      "DICT_APRILTAG_36h11"),
    QT_TRANSLATE_NOOP("Core", "did you mean %1?"),
    QT_TRANSLATE_NOOP("Core", "a ChArUco board needs at least 3 × 3 squares"),
    QT_TRANSLATE_NOOP("Core", "squareSize must be positive and markerSize smaller than it"),
    QT_TRANSLATE_NOOP("Core",
                      "tag family '%1' is not known; expected tag36h11, tag36h10, tag25h9 or "
                      "tag16h5"),
    QT_TRANSLATE_NOOP("Core", "tagSize must be positive"),
    QT_TRANSLATE_NOOP("Core", "tagBorder must be 1 or 2"),
    QT_TRANSLATE_NOOP("Core", "tagCols and tagRows must be at least 1"),
    QT_TRANSLATE_NOOP("Core", "tagSize and tagSpacing must be positive, margin not negative"),
    QT_TRANSLATE_NOOP("Core", "circles need at least 2 × 2 tags"),
    QT_TRANSLATE_NOOP("Core",
                      "circleRadius must be positive and below %1 m, or circles run into the tags"),
    QT_TRANSLATE_NOOP("Core",
                      "measuredLength and drawnLength belong together, both in metres, and no "
                      "print is off by more than a tenth; found %1 and %2"),
    // camera.yaml.
    QT_TRANSLATE_NOOP("Core", "the image size must be positive, found %1"),
    QT_TRANSLATE_NOOP("Core", "the intrinsics must be finite numbers"),
    QT_TRANSLATE_NOOP("Core", "a focal length of %1 px is not plausible for an image %2 px long"),
    QT_TRANSLATE_NOOP("Core", "focal lengths are given in pixels"),
    QT_TRANSLATE_NOOP("Core", "the principal point (%1) px lies far outside the image of %2 px"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: the distortion folds back inside the image: %2 of its 4 corners have no "
                      "ray; are the coefficients right?"),
    QT_TRANSLATE_NOOP("Core", "standard deviations must be 0 or more"),
    QT_TRANSLATE_NOOP("Core",
                      "'distortion' holds %1 standard deviations, but the model has %2 "
                      "coefficients"),
    // Pairs of files.
    QT_TRANSLATE_NOOP("Core", "is no folder"),
    QT_TRANSLATE_NOOP("Core", "give the folder that holds the files"),
    QT_TRANSLATE_NOOP("Core", "give the folder that holds them"),
    QT_TRANSLATE_NOOP("Core", "holds no images; expected png, jpg, bmp or tiff files"),
    QT_TRANSLATE_NOOP("Core", "holds no clouds; expected pcd, ply or KITTI's bin files"),
    QT_TRANSLATE_NOOP("Core", "the names of its files are no times: %1"),
    QT_TRANSLATE_NOOP("Core", "expected seconds, ms, µs or ns: 1650000000.25.png"),
    QT_TRANSLATE_NOOP("Core", "no image and cloud belong together: found %1 and %2"),
    QT_TRANSLATE_NOOP("Core", "give both the same name, the same number, or their times as names"),
    QT_TRANSLATE_NOOP("Core", "%1: no cloud belongs to it"),
    QT_TRANSLATE_NOOP("Core", "%1: no image belongs to it"),
    QT_TRANSLATE_NOOP("Core", "%1 more files without a partner"),
    QT_TRANSLATE_NOOP("Core", "its image has %1 px, the camera's have %2"),
    QT_TRANSLATE_NOOP("Core",
                      "no intrinsics lie with the files; put a camera.yaml into the dataset before "
                      "it is calibrated"),
    QT_TRANSLATE_NOOP("Core", "none of its %1 pairs can be used; %2: %3"),
    QT_TRANSLATE_NOOP("Core", "take an image of this camera, not cropped or scaled"),
    QT_TRANSLATE_NOOP("Core", "the cloud shows no edge"),
    QT_TRANSLATE_NOOP("Core", "take a place with things before others"),
    QT_TRANSLATE_NOOP("Core", "the image shows no edge"),
    QT_TRANSLATE_NOOP("Core", "see whether it is black or blurred"),
    QT_TRANSLATE_NOOP("Core", "no scene has an image and a cloud"),
    QT_TRANSLATE_NOOP("Core", "there is no image with a cloud to check"),
    QT_TRANSLATE_NOOP("Core", "left out: %1"),
    QT_TRANSLATE_NOOP("Core", "reading %1"),
    QT_TRANSLATE_NOOP("Core", "comparing edges"),
    QT_TRANSLATE_NOOP("Core", "none of its clouds can be read"),
    QT_TRANSLATE_NOOP("Core", "holds no clouds"),
    QT_TRANSLATE_NOOP("Core",
                      "holds %1 bytes; expected 16 for each point: x, y, z and reflectance as "
                      "4-byte floats"),
};

}  // namespace lvcalib::widgets
