// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

namespace lvcalib::widgets {

/// What core/recording says about recordings and their stretches; see kCorePatterns.
inline constexpr const char* kImportPatterns[] = {
    // What becomes of a stretch.
    QT_TRANSLATE_NOOP("Core", "rig and board stand still for %1 s"),
    QT_TRANSLATE_NOOP("Core", "stands still for %1 s only; %2 s are needed"),
    QT_TRANSLATE_NOOP("Core", "no sweep was recorded in this time"),
    QT_TRANSLATE_NOOP("Core", "no image was taken in this time"),
    QT_TRANSLATE_NOOP("Core", "its edges were set by hand: %1 s"),
    QT_TRANSLATE_NOOP("Core", "the stretch moved to %1 s to %2 s overlaps that from %3 s to %4 s"),
    QT_TRANSLATE_NOOP("Core", "move its edges so that both stay apart"),
    QT_TRANSLATE_NOOP("Core", "the images stand still, but the clouds change meanwhile"),
    QT_TRANSLATE_NOOP("Core", "the same pose as from %1 s to %2 s, which is longer"),
    QT_TRANSLATE_NOOP("Core", "stands still, but was left out by its time"),
    QT_TRANSLATE_NOOP("Core", "the board is not found in its image: %1"),
    QT_TRANSLATE_NOOP("Core", "its image cannot be read again"),
    QT_TRANSLATE_NOOP("Core", "none of its sweeps can be read"),
    // What to know before.
    QT_TRANSLATE_NOOP("Core",
                      "no CameraInfo was recorded; give a camera file (--camera) for the "
                      "intrinsics"),
    QT_TRANSLATE_NOOP("Core",
                      "no CameraInfo was recorded for %1; put a camera.yaml into the dataset "
                      "before it is calibrated"),
    QT_TRANSLATE_NOOP("Core", "%1; put a camera.yaml into the dataset before it is calibrated"),
    QT_TRANSLATE_NOOP("Core", "%1: holds no intrinsics"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: clouds have no intensity; the calibration will rest on planes and "
                      "corners alone"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: its images change their size; calibrate takes those of the camera's "
                      "size"),
    QT_TRANSLATE_NOOP("Core", "%1: is of images of %2 px, but they have %3"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: is taken for rectified; camera.yaml holds the intrinsics of rectified "
                      "images, without distortion"),
    QT_TRANSLATE_NOOP("Core", "%1: %2 messages a second; motion between them cannot be seen"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: %2 messages cannot be read and are left out, the first because: %3"),
    QT_TRANSLATE_NOOP("Core", "%1: %2 message only"),
    QT_TRANSLATE_NOOP("Core", "%1: %2 messages only"),
    QT_TRANSLATE_NOOP("Core",
                      "the clocks of camera and LiDAR differ by %1; the times at which messages "
                      "were recorded are used instead"),
    QT_TRANSLATE_NOOP("Core", "images and clouds were never recorded at the same time"),
    QT_TRANSLATE_NOOP("Core",
                      "no scene shows the default board, which target.yaml describes; put the "
                      "description of yours in its place, or import with --target"),
    // Files that are damaged, cut off, or something else.
    QT_TRANSLATE_NOOP("Core", "%1: has no metadata.yaml; its %2 file is read"),
    QT_TRANSLATE_NOOP("Core", "%1: has no metadata.yaml; its %2 files are read as one recording"),
    QT_TRANSLATE_NOOP("Core", "%1: named in metadata.yaml and not there; left out"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: has no index (its recording was not ended in good order); read through "
                      "instead, as far as whole messages go"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: its index is missing or damaged; read through instead, as far as whole "
                      "messages go"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: has no end (its recording was not ended in good order, or it is cut "
                      "off); read through instead, as far as whole messages go"),
    QT_TRANSLATE_NOOP("Core", "%1: is damaged or cut off at byte %2 of %3"),
    QT_TRANSLATE_NOOP("Core", "%1: is cut off within the record at byte %2"),
    QT_TRANSLATE_NOOP("Core", "%1: is damaged or cut off within the record at byte %2 of %3"),
    QT_TRANSLATE_NOOP("Core", "%1: is damaged or cut off; the messages that can be read are read"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: the chunk at byte %2 is damaged or cut off; %3 messages of it are read"),
    QT_TRANSLATE_NOOP("Core", "%1: the times of its messages go back; some are read out of order"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: its compressed data are damaged or cut off; the part before is read"),
    QT_TRANSLATE_NOOP("Core", "%1: %2 compressed messages are damaged; left out"),
    QT_TRANSLATE_NOOP("Core", "the ROS 1 bag ends within its header"),
    QT_TRANSLATE_NOOP("Core", "copy or record it again"),
    QT_TRANSLATE_NOOP("Core", "is a ROS 1 bag of version %1; expected 2.0"),
    QT_TRANSLATE_NOOP("Core", "convert it with 'rosbag fix' or 'rosbag migrate' of ROS 1"),
    QT_TRANSLATE_NOOP("Core", "the rosbag2 database cannot be read: %1"),
    QT_TRANSLATE_NOOP("Core", "it needs rosbag2's tables topics and messages; copy the file again"),
    QT_TRANSLATE_NOOP("Core", "is empty, expected a recording"),
    QT_TRANSLATE_NOOP("Core",
                      "is no recording that can be read; expected a ROS 1 bag (.bag), a rosbag2 "
                      "folder, or one of its files (.db3, .mcap)"),
    QT_TRANSLATE_NOOP("Core", "what matters is the file's content, not its name"),
    QT_TRANSLATE_NOOP("Core",
                      "is a folder without a recording; expected metadata.yaml, or .db3, .mcap or "
                      ".bag files"),
    QT_TRANSLATE_NOOP("Core", "a folder of scenes needs no import: lvcalib calibrate takes it"),
    // Why nothing can be imported.
    QT_TRANSLATE_NOOP("Core", "%1: holds no messages"),
    QT_TRANSLATE_NOOP("Core", "holds no messages"),
    QT_TRANSLATE_NOOP("Core", "%1: holds no images (sensor_msgs/Image or CompressedImage)"),
    QT_TRANSLATE_NOOP("Core", "%1: holds no clouds (sensor_msgs/PointCloud2 or Livox CustomMsg)"),
    QT_TRANSLATE_NOOP("Core", "holds no images (sensor_msgs/Image or CompressedImage)"),
    QT_TRANSLATE_NOOP("Core", "holds no clouds (sensor_msgs/PointCloud2 or Livox CustomMsg)"),
    QT_TRANSLATE_NOOP("Core",
                      "%1: holds no %2 but raw packets: %3 (play it through %4 and record what "
                      "comes out)"),
    QT_TRANSLATE_NOOP("Core", "holds no %1 but raw packets: %2"),
    QT_TRANSLATE_NOOP("Core", "images"),
    QT_TRANSLATE_NOOP("Core", "clouds"),
    QT_TRANSLATE_NOOP("Core", "play it through %1 and record what comes out"),
    QT_TRANSLATE_NOOP("Core", "none of its images can be read: %1"),
    QT_TRANSLATE_NOOP("Core", "none of its clouds can be read: %1"),
    QT_TRANSLATE_NOOP("Core",
                      "rig and board never stand still: something moves in images or clouds all "
                      "the time"),
    QT_TRANSLATE_NOOP("Core", "let everything rest for two seconds or more at each board pose"),
    QT_TRANSLATE_NOOP("Core",
                      "none of its %1 still stretches can be used; that from %2 s to %3 s: %4"),
    QT_TRANSLATE_NOOP("Core", "exists already"),
    QT_TRANSLATE_NOOP("Core", "exists already and is no import"),
    QT_TRANSLATE_NOOP("Core", "choose another name, or replace it with --force"),
    QT_TRANSLATE_NOOP("Core", "choose another name"),
    QT_TRANSLATE_NOOP("Core", "is no name for a dataset folder"),
};

}  // namespace lvcalib::widgets
