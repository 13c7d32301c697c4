<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>Choices</name>
    <message>
        <source>Projects (*.lvcalib)</source>
        <translation>项目 (*.lvcalib)</translation>
    </message>
    <message>
        <source>Open a dataset folder</source>
        <translation>打开数据集文件夹</translation>
    </message>
    <message>
        <source>Open a project</source>
        <translation>打开项目</translation>
    </message>
    <message>
        <source>Save the project</source>
        <translation>保存项目</translation>
    </message>
    <message>
        <source>Add a scene folder (image and cloud)</source>
        <translation>添加场景文件夹（图像和点云）</translation>
    </message>
    <message>
        <source>Export the result</source>
        <translation>导出结果</translation>
    </message>
    <message>
        <source>Unsaved decisions</source>
        <translation>未保存的决定</translation>
    </message>
    <message>
        <source>Save your decisions about %1?</source>
        <translation>保存您对 %1 的决定吗？</translation>
    </message>
    <message>
        <source>Dataset not found</source>
        <translation>找不到数据集</translation>
    </message>
    <message>
        <source>The project&apos;s dataset is not at
%1
any more. Where is it now?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unsaved decisions found</source>
        <translation>发现未保存的决定</translation>
    </message>
    <message>
        <source>The program ended last time before your decisions about
%1
were saved. Take them up again?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets</name>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>存疑</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>Quality:</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 scenes, %2 px (corners), %3 mm (LiDAR)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>roll</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pitch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>yaw</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unbounded</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Translation (LiDAR origin in the camera frame)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Roll, pitch, yaw (R = Rz·Ry·Rx)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>T_camera_lidar</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Quaternion x y z w</source>
        <translation>四元数 x y z w</translation>
    </message>
    <message>
        <source>Standard deviations along the camera&apos;s axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Weak directions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None: the scenes determine all six.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>警告</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::AngleDistancePlot</name>
    <message>
        <source>Signed distance from the circle (mm, outside positive) against the polar angle (degrees). Dots: LiDAR samples coloured by intensity. Marks: where the intensity crosses its middle level in each angular bin, ±1σ. Line: the fitted wave Δcu·cos ψ + Δcv·sin ψ + Δr. Shaded: refused bins.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>polar angle ψ (°)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>distance from the circle (mm)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BarPlot</name>
    <message>
        <source>no data</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoardMapPlot</name>
    <message>
        <source>board x (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>board y (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The board from the front. Lines: how each circle&apos;s centre moved from the first to the last iteration, enlarged. Ellipse: twice the standard deviation of the refined centre, enlarged alike. Cross: where the model has it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no circles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>paths enlarged ×%1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoxPlot</name>
    <message>
        <source>no data</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::Builder</name>
    <message>
        <source>Only the board&apos;s points are loaded.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No board was found in this scene&apos;s cloud yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud is not loaded yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There are no boundary samples in this scene.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No crop box is set: all points are shown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera colours need an image and an extrinsic; intensity is shown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>camera colour (grey: not in the image)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This cloud has no intensity; range is shown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The board&apos;s plane is not known in this scene; range is shown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>height z (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>range (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>range beyond the board&apos;s plane (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>intensity</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudPane</name>
    <message>
        <source>Cloud</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plane residual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera colour</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the colours tell: intensity as recorded, height z (m), range (m), range beyond the board&apos;s plane (mm), or the camera&apos;s own colours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colour of the points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Crop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Boundary samples</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which points are shown: all, those in the crop box, those about the board, or those beside the circles&apos; edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Crop…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show a box with handles: the board is searched inside it only (C)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of points shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudSceneBuilder</name>
    <message>
        <source>There is not enough memory to show this cloud.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudView</name>
    <message>
        <source>Point cloud</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The cloud cannot be drawn: no OpenGL 3.2 on this screen.
Install a graphics driver (or Mesa&apos;s software renderer).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag: turn. Shift+drag or middle button: move. Wheel or right button: zoom. Click: values of a point. Lengths in metres.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show all points obliquely</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Top</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look from above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sensor</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look from the LiDAR&apos;s origin</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ConvergencePlot</name>
    <message>
        <source>iteration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>move (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thin lines: size of each circle&apos;s own correction in every iteration (mm), which ends at its measurement noise. Thick line: largest move of a centre after the projection to the layout; the refinement ends when it is small.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no iterations</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CropForm</name>
    <message>
        <source>roll</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pitch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>yaw</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle of the box along the LiDAR&apos;s %1 axis, in metres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of the box along its own %1 axis, in metres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn of the box (%1), in degrees: roll about x, then pitch about y, then yaw about z of the LiDAR</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use this crop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search the board only inside the box; runs this scene again from there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No crop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search the board in the whole cloud again</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ErrorDialog</name>
    <message>
        <source>No trustworthy result</source>
        <translation>没有可信的结果</translation>
    </message>
    <message>
        <source>This cannot be used</source>
        <translation>无法使用</translation>
    </message>
    <message>
        <source>Where:</source>
        <translation>位置：</translation>
    </message>
    <message>
        <source>What to do:</source>
        <translation>处理方法：</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>复制</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ExtrinsicPage</name>
    <message>
        <source>Pose and quality</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals and influence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cloud in camera colours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>corner RMS (px)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LiDAR RMS (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>corner residual (px)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>node residual (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moves without it (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>turns without it (mrad)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Root mean square of the tag corners&apos; reprojection residuals, per scene (px). Pale: not used. Click: go to the scene.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Root mean square of the refined LiDAR nodes against the board&apos;s model, per scene (mm); without circles, of the plane&apos;s height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths of the corner residuals per scene (px): median, quartiles, whiskers to 1.5 box lengths, circles beyond</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths of the node residuals per scene (mm): median, quartiles, whiskers to 1.5 box lengths, circles beyond</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the LiDAR&apos;s origin moves when the scene is left out (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the extrinsic turns when the scene is left out (mrad)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Run the calibration to see its result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>this board has no circles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>needs three used scenes or more</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::FigureActions</name>
    <message>
        <source>Save figure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save as PNG…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PNG image (*.png)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save as PDF…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save data as CSV…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Comma-separated values (*.csv)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::GuideDialog</name>
    <message>
        <source>Guide</source>
        <translation>指南</translation>
    </message>
    <message>
        <source># From the board to a result
1. **Print the board** at 1:1 with `lvcalib target target.yaml -o board.pdf`, glue it on something flat and measure a tag.
2. **Take three to ten scenes**: an image and a cloud each, the board at 2–4 m, turned differently each time, seen whole by both sensors.
3. **Lay out the folder**: `target.yaml`, `camera.yaml`, `scenes/NAME/image.png` and `scenes/NAME/cloud.pcd`.
4. **Open it and press F5.** No rough guess is needed.
5. **Look**: every scene should be *used*; a scene whose px, mm or influence stands out deserves a look on the Scene page. Untick it and the result follows at once.
6. **Export** with Ctrl+E.

# Pages
- **Scene**: cloud and image of the scene that is selected in the list, with what was found in them. A crop box helps where the board is not found.
- **Refinement**: how each circle&apos;s centre was found, bin by bin.
- **Extrinsic**: the pose, its standard deviations and how the scenes agree.

# Keys
F5 runs all, Esc cancels, Ctrl+Z undoes, Ctrl+1 to Ctrl+3 change the page, Ctrl+J rejects and Ctrl+U accepts the selected scenes, Space ticks and unticks.
</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImagePane</name>
    <message>
        <source>Image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tags</source>
        <translation>标签</translation>
    </message>
    <message>
        <source>Outlines and ids of the detected tags (green)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detected minus predicted corner (px), enlarged (magenta arrows)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How much longer than life residual arrows are drawn</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enlargement of residuals</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Circles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Board outline, circles and their centres as the LiDAR sees them, projected with the extrinsic (orange)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点数</translation>
    </message>
    <message>
        <source>The points of the cloud view, projected with the extrinsic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the whole image (F)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1:1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One image pixel per screen pixel (1)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Levels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Black</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grey value shown as black (0 … 255 of full scale)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>White</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grey value shown as white (0 … 255 of full scale)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Auto</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Levels that show the central 99 % of the pixels with most contrast</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pixel under the cursor (x, y) and its grey value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>(%1, %2): %3</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImageView</name>
    <message>
        <source>Image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wheel: zoom. Drag: move. F: fit, 1: one to one. Click: nearest LiDAR points. Green: detected tags. Magenta arrows: corner residuals, enlarged (px). Orange: circles and outline from the LiDAR.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One to one</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::LogDock</name>
    <message>
        <source>Log</source>
        <translation>日志</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::MainActions</name>
    <message>
        <source>&amp;File</source>
        <translation>文件(&amp;F)</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>编辑(&amp;E)</translation>
    </message>
    <message>
        <source>&amp;Run</source>
        <translation>运行(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>视图(&amp;V)</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>帮助(&amp;H)</translation>
    </message>
    <message>
        <source>Open &amp;recent</source>
        <translation>最近打开(&amp;R)</translation>
    </message>
    <message>
        <source>&amp;Colours</source>
        <translation>配色(&amp;C)</translation>
    </message>
    <message>
        <source>&amp;Language</source>
        <translation>语言(&amp;L)</translation>
    </message>
    <message>
        <source>Tool bar</source>
        <translation>工具栏</translation>
    </message>
    <message>
        <source>&amp;Open dataset…</source>
        <translation>打开数据集(&amp;O)…</translation>
    </message>
    <message>
        <source>Open a dataset folder</source>
        <translation>打开数据集文件夹</translation>
    </message>
    <message>
        <source>Open &amp;project…</source>
        <translation>打开项目(&amp;P)…</translation>
    </message>
    <message>
        <source>Open a .lvcalib file</source>
        <translation>打开 .lvcalib 文件</translation>
    </message>
    <message>
        <source>Try the &amp;demo</source>
        <translation>试用演示(&amp;D)</translation>
    </message>
    <message>
        <source>Simulate three scenes and open them</source>
        <translation>仿真三个场景并打开</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>保存(&amp;S)</translation>
    </message>
    <message>
        <source>Save the decisions as a project</source>
        <translation>将所作决定保存为项目</translation>
    </message>
    <message>
        <source>Save &amp;as…</source>
        <translation>另存为(&amp;A)…</translation>
    </message>
    <message>
        <source>Save the project under another name</source>
        <translation>以其他名称保存项目</translation>
    </message>
    <message>
        <source>R&amp;esults…</source>
        <translation>结果(&amp;E)…</translation>
    </message>
    <message>
        <source>Show and export the result</source>
        <translation>显示并导出结果</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>退出(&amp;Q)</translation>
    </message>
    <message>
        <source>Leave the program</source>
        <translation>退出程序</translation>
    </message>
    <message>
        <source>&amp;Run all</source>
        <translation>全部运行(&amp;R)</translation>
    </message>
    <message>
        <source>Run everything that is not up to date</source>
        <translation>运行所有未更新的步骤</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>取消(&amp;C)</translation>
    </message>
    <message>
        <source>Stop what is running</source>
        <translation>停止当前运行</translation>
    </message>
    <message>
        <source>Use board.pcd &amp;files</source>
        <translation>使用 board.pcd 文件(&amp;F)</translation>
    </message>
    <message>
        <source>Take a scene&apos;s board.pcd instead of its whole cloud where there is one</source>
        <translation>若场景有 board.pcd，则用它代替完整点云</translation>
    </message>
    <message>
        <source>&amp;Guide</source>
        <translation>指南(&amp;G)</translation>
    </message>
    <message>
        <source>From the printed board to a result</source>
        <translation>从打印标定板到结果</translation>
    </message>
    <message>
        <source>&amp;About</source>
        <translation>关于(&amp;A)</translation>
    </message>
    <message>
        <source>Version and licence</source>
        <translation>版本与许可</translation>
    </message>
    <message>
        <source>As the &amp;system</source>
        <translation>跟随系统(&amp;S)</translation>
    </message>
    <message>
        <source>&amp;Light</source>
        <translation>浅色(&amp;L)</translation>
    </message>
    <message>
        <source>&amp;Dark</source>
        <translation>深色(&amp;D)</translation>
    </message>
    <message>
        <source>Simulate four scenes and open them, with a guided tour</source>
        <translation>模拟四个场景并打开，附带导览</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::MainWindow</name>
    <message>
        <source>Exported %1.</source>
        <translation>已导出 %1。</translation>
    </message>
    <message>
        <source>Exported %1</source>
        <translation>已导出 %1</translation>
    </message>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>LV-Calib Workbench %1

LiDAR–camera calibration with a printed board.
GPL-3.0-or-later (core library: BSD-3-Clause)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LV-Calib Workbench</source>
        <translation>LV-Calib 工作台</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PageStack</name>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>精化</translation>
    </message>
    <message>
        <source>Extrinsic</source>
        <translation>外参</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>模型</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ParametersDock</name>
    <message>
        <source>Parameters</source>
        <translation>参数</translation>
    </message>
    <message>
        <source>Reset all parameters</source>
        <translation>重置全部参数</translation>
    </message>
    <message>
        <source>Detection</source>
        <translation>检测</translation>
    </message>
    <message>
        <source>Localisation</source>
        <translation>定位</translation>
    </message>
    <message>
        <source>Consensus</source>
        <translation>一致性</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>精化</translation>
    </message>
    <message>
        <source>Extrinsic</source>
        <translation>外参</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>质量</translation>
    </message>
    <message>
        <source>Default: %1.</source>
        <translation>默认值：%1。</translation>
    </message>
    <message>
        <source>on</source>
        <translation>开</translation>
    </message>
    <message>
        <source>off</source>
        <translation>关</translation>
    </message>
    <message>
        <source>Range %1 to %2, default %3.</source>
        <translation>范围 %1 至 %2，默认值 %3。</translation>
    </message>
    <message>
        <source>Back to the default %1</source>
        <translation>恢复默认值 %1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PlotView</name>
    <message>
        <source>Show everything</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::RefinementPage</name>
    <message>
        <source>Choose a scene and run the calibration to see its refinement.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angle (°)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Midpoint (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>σ (mm)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Samples</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Angular bins of the chosen node</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every angular bin of the chosen node: where the intensity crosses its middle level (mm from the circle), its standard deviation, and why it was refused</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replay the iterations from the first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replay</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Iteration shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Iteration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This scene was not refined.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This scene was not refined: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This board has no circles: there is nothing to refine.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>node %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>node %1: not usable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>node %1: |Δc| %2 mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>iteration %1 of %2, largest move %3 mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 of %2 bins used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; Δcu %1, Δcv %2, Δr %3 mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; levels %1 and %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; not usable: %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResultsDialog</name>
    <message>
        <source>Results</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Takes a point from the LiDAR frame to the camera frame (x right, y down, z forward); lengths in metres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy matrix</source>
        <translation>复制矩阵</translation>
    </message>
    <message>
        <source>Export YAML…</source>
        <translation>导出 YAML…</translation>
    </message>
    <message>
        <source>YAML (*.yaml)</source>
        <translation>YAML (*.yaml)</translation>
    </message>
    <message>
        <source>Export JSON…</source>
        <translation>导出 JSON…</translation>
    </message>
    <message>
        <source>JSON (*.json)</source>
        <translation>JSON (*.json)</translation>
    </message>
    <message>
        <source>Translation x y z</source>
        <translation>平移 x y z</translation>
    </message>
    <message>
        <source>± one standard deviation</source>
        <translation>± 一倍标准差</translation>
    </message>
    <message>
        <source>Quaternion x y z w</source>
        <translation>四元数 x y z w</translation>
    </message>
    <message>
        <source>Roll, pitch, yaw</source>
        <translation>横滚、俯仰、偏航</translation>
    </message>
    <message>
        <source>Rotation about camera x y z, ± σ</source>
        <translation>绕相机 x y z 轴旋转的 ±σ</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>存疑</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>Quality: %1</source>
        <translation>质量：%1</translation>
    </message>
    <message>
        <source>T_camera_lidar from %1 of %2 scenes; %3 px at the tag corners, %4 mm at the LiDAR nodes (root mean square).</source>
        <translation>T_camera_lidar 由 %1/%2 个场景求得；标签角点 %3 px，激光节点 %4 mm（均方根）。</translation>
    </message>
    <message>
        <source>Weakly determined</source>
        <translation>约束较弱</translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>警告</translation>
    </message>
    <message>
        <source>None.</source>
        <translation>无。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::SceneModel</name>
    <message>
        <source>missing on disk</source>
        <translation>磁盘上缺失</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>已剔除</translation>
    </message>
    <message>
        <source>not run yet</source>
        <translation>尚未运行</translation>
    </message>
    <message>
        <source> (cropped)</source>
        <translation>（已裁剪）</translation>
    </message>
    <message>
        <source>used</source>
        <translation>已使用</translation>
    </message>
    <message>
        <source>to be run</source>
        <translation>待运行</translation>
    </message>
    <message>
        <source>Scene %1. Ticked: it takes part in the calibration.</source>
        <translation>场景 %1。勾选表示参与标定。</translation>
    </message>
    <message>
        <source>Without this scene the result moves by %1 mm and %2 mrad.</source>
        <translation>去掉该场景后结果移动 %1 mm、%2 mrad。</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Ticked scenes take part in the calibration.</source>
        <translation>勾选的场景参与标定。</translation>
    </message>
    <message>
        <source>Tags</source>
        <translation>标签</translation>
    </message>
    <message>
        <source>Tags found in the image.</source>
        <translation>图像中找到的标签数。</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点数</translation>
    </message>
    <message>
        <source>LiDAR points on the board.</source>
        <translation>标定板上的激光点数。</translation>
    </message>
    <message>
        <source>px</source>
        <translation>px</translation>
    </message>
    <message>
        <source>Root mean square of the tag corners&apos; reprojection errors, px.</source>
        <translation>标签角点重投影误差的均方根（px）。</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Root mean square distance of LiDAR nodes to the board&apos;s, mm.</source>
        <translation>激光节点到标定板节点距离的均方根（mm）。</translation>
    </message>
    <message>
        <source>Infl.</source>
        <translation>影响</translation>
    </message>
    <message>
        <source>Influence: how far the result moves without this scene, mm.</source>
        <translation>影响：去掉该场景后结果移动的距离（mm）。</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Whether the scene is used, and why not.</source>
        <translation>场景是否被使用及原因。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ScenePage</name>
    <message>
        <source>Choose a scene in the list.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The image is being loaded …</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point %1: x %2, y %3, z %4 m, range %5 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, intensity %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, line %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, time %1 ms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, %1 mm beyond the board&apos;s plane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, pixel (%1, %2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, not in the image</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pixel (%1, %2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>: no LiDAR point within %1 px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>. Nearest: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>: LiDAR points are linked once there is an extrinsic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>(%1, %2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tag %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>: corner residuals %1 px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; LiDAR points on it: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click a point, a pixel or a tag to see its values in both views.</source>
        <translation type="unfinished"></translation>
    </message>
    <message numerus="yes">
        <source>%n measurements selected on the Model page</source>
        <translation>
            <numerusform>模型页上选中了 %n 个测量值</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ScenesDock</name>
    <message>
        <source>Scenes</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>采用</translation>
    </message>
    <message>
        <source>Use the selected scenes</source>
        <translation>采用所选场景</translation>
    </message>
    <message>
        <source>Reject</source>
        <translation>剔除</translation>
    </message>
    <message>
        <source>Leave the selected scenes out</source>
        <translation>不使用所选场景</translation>
    </message>
    <message>
        <source>Run again</source>
        <translation>重新运行</translation>
    </message>
    <message>
        <source>Run all stages of the selected scenes again</source>
        <translation>重新运行所选场景的全部步骤</translation>
    </message>
    <message>
        <source>Remove crop box</source>
        <translation>移除裁剪框</translation>
    </message>
    <message>
        <source>Search the whole clouds of the selected scenes</source>
        <translation>在所选场景的完整点云中搜索</translation>
    </message>
    <message>
        <source>Add scenes…</source>
        <translation>添加场景…</translation>
    </message>
    <message>
        <source>Add scene folders from elsewhere</source>
        <translation>从其他位置添加场景文件夹</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::StatusLine</name>
    <message>
        <source>Reading</source>
        <translation>读取</translation>
    </message>
    <message>
        <source>Looking at images</source>
        <translation>检测图像</translation>
    </message>
    <message>
        <source>Searching</source>
        <translation>搜索标定板</translation>
    </message>
    <message>
        <source>Refining</source>
        <translation>精化</translation>
    </message>
    <message>
        <source>Solving</source>
        <translation>求解</translation>
    </message>
    <message>
        <source>Simulating</source>
        <translation>仿真</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>存疑</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>%1 (out of date)</source>
        <translation>%1（已过期）</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::WelcomePage</name>
    <message>
        <source>LV-Calib Workbench</source>
        <translation>LV-Calib 工作台</translation>
    </message>
    <message>
        <source>Finds how a camera and a LiDAR stand to each other from a few scenes of a printed board, says how sure it is, and shows why.</source>
        <translation>由若干张打印标定板场景求出相机与激光雷达的相对位姿，给出不确定度并说明依据。</translation>
    </message>
    <message>
        <source>Open a dataset</source>
        <translation>打开数据集</translation>
    </message>
    <message>
        <source>A folder with target.yaml, camera.yaml and scenes</source>
        <translation>包含 target.yaml、camera.yaml 和 scenes 的文件夹</translation>
    </message>
    <message>
        <source>Open a project</source>
        <translation>打开项目</translation>
    </message>
    <message>
        <source>A dataset with your decisions about it (.lvcalib)</source>
        <translation>数据集及您的决定（.lvcalib）</translation>
    </message>
    <message>
        <source>Try the demo</source>
        <translation>试用演示</translation>
    </message>
    <message>
        <source>Simulates three scenes whose true calibration is known</source>
        <translation>仿真三个真值已知的场景</translation>
    </message>
    <message>
        <source>Guide</source>
        <translation>指南</translation>
    </message>
    <message>
        <source>From the printed board to a result, step by step</source>
        <translation>从打印标定板到结果的逐步说明</translation>
    </message>
    <message>
        <source>Recent (or drop a folder on this window)</source>
        <translation>最近打开（也可将文件夹拖到此窗口）</translation>
    </message>
    <message>
        <source>Simulates four scenes with an effect hidden in them, and a tour to find it</source>
        <translation>模拟四个藏有一个效应的场景，并带您找到它</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::Workspace</name>
    <message>
        <source>Cancelled.</source>
        <translation>已取消。</translation>
    </message>
    <message>
        <source>Cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>Autosave: %1</source>
        <translation>自动保存：%1</translation>
    </message>
    <message numerus="yes">
        <source>Opened %1 with %n scenes.</source>
        <translation type="unfinished">
            <numerusform></numerusform>
        </translation>
    </message>
    <message>
        <source>Saved %1.</source>
        <translation>已保存 %1。</translation>
    </message>
    <message>
        <source>accept %1</source>
        <translation>采用 %1</translation>
    </message>
    <message>
        <source>reject %1</source>
        <translation>剔除 %1</translation>
    </message>
    <message>
        <source>crop %1</source>
        <translation>裁剪 %1</translation>
    </message>
    <message>
        <source>uncrop %1</source>
        <translation>取消裁剪 %1</translation>
    </message>
    <message>
        <source>change %1</source>
        <translation>修改 %1</translation>
    </message>
    <message>
        <source>reset all parameters</source>
        <translation>重置全部参数</translation>
    </message>
    <message>
        <source>use board.pcd files</source>
        <translation>使用 board.pcd 文件</translation>
    </message>
    <message>
        <source>use whole clouds</source>
        <translation>使用完整点云</translation>
    </message>
    <message numerus="yes">
        <source>add %n scenes</source>
        <translation type="unfinished">
            <numerusform></numerusform>
        </translation>
    </message>
    <message>
        <source>No result: %1</source>
        <translation>没有结果：%1</translation>
    </message>
    <message>
        <source>%1: %2 of %3 scenes, %4 px, %5 mm</source>
        <translation>%1：%2/%3 个场景，%4 px，%5 mm</translation>
    </message>
</context>
<context>
    <name>main</name>
    <message>
        <source>LiDAR-camera calibration with a printed board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder for settings and data, instead of the user&apos;s.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dataset folder or project.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ModelText</name>
    <message>
        <source>board x</source>
        <translation>板面 x</translation>
    </message>
    <message>
        <source>board y</source>
        <translation>板面 y</translation>
    </message>
    <message>
        <source>board radius</source>
        <translation>板面半径</translation>
    </message>
    <message>
        <source>range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>azimuth</source>
        <translation>方位角</translation>
    </message>
    <message>
        <source>elevation</source>
        <translation>仰角</translation>
    </message>
    <message>
        <source>incidence</source>
        <translation>入射角</translation>
    </message>
    <message>
        <source>tilt direction</source>
        <translation>倾斜方向</translation>
    </message>
    <message>
        <source>scene clock</source>
        <translation>场景时序</translation>
    </message>
    <message>
        <source>time in scan</source>
        <translation>扫描内时间</translation>
    </message>
    <message>
        <source>scan speed</source>
        <translation>扫描速度</translation>
    </message>
    <message>
        <source>scan direction</source>
        <translation>扫描方向</translation>
    </message>
    <message>
        <source>laser line</source>
        <translation>激光线</translation>
    </message>
    <message>
        <source>image x</source>
        <translation>图像 x</translation>
    </message>
    <message>
        <source>image y</source>
        <translation>图像 y</translation>
    </message>
    <message>
        <source>image radius</source>
        <translation>图像半径</translation>
    </message>
    <message>
        <source>radial from image centre</source>
        <translation>相对图像中心的径向</translation>
    </message>
    <message>
        <source>radial from tag centre</source>
        <translation>相对标签中心的径向</translation>
    </message>
    <message>
        <source>tag size</source>
        <translation>标签大小</translation>
    </message>
    <message>
        <source>sub-pixel phase</source>
        <translation>亚像素相位</translation>
    </message>
    <message>
        <source>tag</source>
        <translation>标签</translation>
    </message>
    <message>
        <source>corner and axis</source>
        <translation>角点与轴</translation>
    </message>
    <message>
        <source>darkness</source>
        <translation>暗度</translation>
    </message>
    <message>
        <source>print</source>
        <translation>印刷</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>inverse range</source>
        <translation>距离倒数</translation>
    </message>
    <message>
        <source>distance to edge</source>
        <translation>到边缘的距离</translation>
    </message>
    <message>
        <source>polar angle</source>
        <translation>极角</translation>
    </message>
    <message>
        <source>polar angle to tilt</source>
        <translation>相对倾斜的极角</translation>
    </message>
    <message>
        <source>polar angle to LiDAR axes</source>
        <translation>相对激光雷达轴的极角</translation>
    </message>
    <message>
        <source>scan across edge</source>
        <translation>横过边缘的扫描</translation>
    </message>
    <message>
        <source>contrast</source>
        <translation>对比度</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>圆</translation>
    </message>
    <message>
        <source>corner</source>
        <translation>角点</translation>
    </message>
    <message>
        <source>boundary</source>
        <translation>边界</translation>
    </message>
    <message>
        <source>log. intensity</source>
        <translation>对数强度</translation>
    </message>
    <message>
        <source>white</source>
        <translation>白</translation>
    </message>
    <message>
        <source>black</source>
        <translation>黑</translation>
    </message>
    <message>
        <source>present</source>
        <translation>存在</translation>
    </message>
    <message>
        <source>absent</source>
        <translation>不存在</translation>
    </message>
    <message>
        <source>one of several</source>
        <translation>若干之一</translation>
    </message>
    <message>
        <source>cannot tell</source>
        <translation>无法判断</translation>
    </message>
    <message>
        <source>%1%2 (held)</source>
        <translation>%1%2（固定）</translation>
    </message>
    <message>
        <source>base model</source>
        <translation>基础模型</translation>
    </message>
    <message>
        <source>%1 held</source>
        <translation>%1 固定</translation>
    </message>
    <message>
        <source>%1 fitted</source>
        <translation>%1 拟合</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::AddEffectDialog</name>
    <message>
        <source>A&amp;dd</source>
        <translation>添加(&amp;D)</translation>
    </message>
    <message>
        <source>Add an effect</source>
        <translation>添加效应</translation>
    </message>
    <message>
        <source>Catalogue</source>
        <translation>目录</translation>
    </message>
    <message>
        <source>Formula</source>
        <translation>公式</translation>
    </message>
    <message>
        <source>Curve</source>
        <translation>曲线</translation>
    </message>
    <message>
        <source>leaves no pattern in these scenes</source>
        <translation>在这些场景中不留下图样</translation>
    </message>
    <message>
        <source>Search by name, physics or formula</source>
        <translation>按名称、物理含义或公式搜索</translation>
    </message>
    <message>
        <source>What is added to the measurement, in m (range, boundary), px (corner) or the logarithm of the intensity. Covariates are in m, rad and px. Other names are coefficients, which are fitted; the formula must be linear in them.</source>
        <translation>加到测量值上的量，单位为 m（距离、边界）、px（角点）或强度的对数。协变量的单位为 m、rad 和 px。其他名称是待拟合的系数；公式对它们必须是线性的。</translation>
    </message>
    <message>
        <source>Channel</source>
        <translation>通道</translation>
    </message>
    <message>
        <source>Covariates</source>
        <translation>协变量</translation>
    </message>
    <message>
        <source>A smooth curve stands in for a cause that nobody knows yet. Of two covariates it is a surface.</source>
        <translation>平滑曲线用来代替尚不知道的原因；两个协变量时为曲面。</translation>
    </message>
    <message>
        <source>Along</source>
        <translation>沿</translation>
    </message>
    <message>
        <source>and</source>
        <translation>和</translation>
    </message>
    <message>
        <source>&lt;p&gt;No effect matches.&lt;/p&gt;</source>
        <translation>&lt;p&gt;没有匹配的效应。&lt;/p&gt;</translation>
    </message>
    <message>
        <source>Formula:</source>
        <translation>公式：</translation>
    </message>
    <message>
        <source>To tell it from others:</source>
        <translation>与其他效应区分的办法：</translation>
    </message>
    <message>
        <source>Source:</source>
        <translation>来源：</translation>
    </message>
    <message>
        <source>its pattern is being drawn …</source>
        <translation>正在绘制其图样……</translation>
    </message>
    <message>
        <source>not with these measurements</source>
        <translation>这些测量值无法使用</translation>
    </message>
    <message>
        <source>nothing else</source>
        <translation>无其他</translation>
    </message>
    <message>
        <source>Cannot be used here: %1</source>
        <translation>此处无法使用：%1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoardIntensityView</name>
    <message>
        <source>Intensity over the board: measured, as the model predicts it, and the difference (blue: darker than predicted, red: brighter).</source>
        <translation>标定板上的强度：测量值、模型预测值和差值（蓝色：比预测暗，红色：比预测亮）。</translation>
    </message>
    <message>
        <source>no intensity in these clouds</source>
        <translation>这些点云没有强度</translation>
    </message>
    <message>
        <source>measured (%1 … %2)</source>
        <translation>测量（%1 … %2）</translation>
    </message>
    <message>
        <source>predicted</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>difference (±%1)</source>
        <translation>差值（±%1）</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BudgetPlot</name>
    <message>
        <source>The history of the error appears here.</source>
        <translation>误差的历史显示在这里。</translation>
    </message>
    <message>
        <source>squared error (%)</source>
        <translation>平方误差 (%)</translation>
    </message>
    <message>
        <source>Squared error by the base model&apos;s: grey noise, red unexplained, green explained by effects; diamonds: scenes held out. Click to go to a step.</source>
        <translation>相对于基础模型的平方误差：灰色为噪声，红色为未解释，绿色为效应已解释；菱形：留出的场景。单击可转到某一步。</translation>
    </message>
    <message>
        <source>Step %1, %2: %3
RMS %4, noise %5, unexplained %6, held out %7 (%8)</source>
        <translation>第 %1 步，%2：%3
均方根 %4，噪声 %5，未解释 %6，留出 %7（%8）</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CoachMarks</name>
    <message>
        <source>Done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>下一步</translation>
    </message>
    <message>
        <source>End the tour</source>
        <translation>结束导览</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::DemoTour</name>
    <message>
        <source>These scenes were simulated just now, by a LiDAR with an error that the calibration does not know. Press &lt;b&gt;Run all&lt;/b&gt;.</source>
        <translation>这些场景刚刚模拟生成，所用激光雷达有一个标定并不知道的误差。请按&lt;b&gt;全部运行&lt;/b&gt;。</translation>
    </message>
    <message>
        <source>The calibration is done, and its figures look fine. Open the &lt;b&gt;Model&lt;/b&gt; page to ask what it misses.</source>
        <translation>标定已完成，数值看起来不错。打开&lt;b&gt;模型&lt;/b&gt;页，看看它遗漏了什么。</translation>
    </message>
    <message>
        <source>The effects that may be missing are being tried; scenes held out decide. The best one comes first, with a sentence on what was seen and how sure that is.</source>
        <translation>正在逐一尝试可能遗漏的效应，由留出的场景决定。最好的排在最前，并用一句话说明看到了什么、有多大把握。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Range walk&lt;/b&gt;: dark print reads too far. The orange curve is its pattern at the size found; the marks are what is measured.</source>
        <translation>&lt;b&gt;Range walk&lt;/b&gt;（距离随强度漂移）：深色印刷读数偏远。橙色曲线是按所得大小绘出的图样，标记是测量值。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Add&lt;/b&gt; it to the model.</source>
        <translation>把它&lt;b&gt;添加&lt;/b&gt;到模型中。</translation>
    </message>
    <message>
        <source>The red, unexplained share is gone, in scenes held out as well (diamonds), and the extrinsic has moved. Click an earlier step or undo to compare.</source>
        <translation>红色的未解释部分消失了，留出的场景（菱形）也一样，外参随之移动。单击较早的步骤或撤销以作比较。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::MissingPane</name>
    <message>
        <source>its pattern cannot be seen</source>
        <translation>看不到其图样</translation>
    </message>
    <message>
        <source>or: %1</source>
        <translation>或：%1</translation>
    </message>
    <message>
        <source>Predicted fall of the squared error in scenes held out</source>
        <translation>留出场景中平方误差的预计降幅</translation>
    </message>
    <message>
        <source>%1 against %2</source>
        <translation>%1 对 %2</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>Looking for what is missing …</source>
        <translation>正在查找遗漏的效应……</translation>
    </message>
    <message>
        <source>Nobody has looked yet.</source>
        <translation>尚未查找。</translation>
    </message>
    <message>
        <source>Run the calibration first.</source>
        <translation>请先运行标定。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Nothing is missing&lt;/b&gt; in the model, as far as these scenes can tell.</source>
        <translation>就这些场景而言，模型中&lt;b&gt;没有遗漏&lt;/b&gt;。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Something is left&lt;/b&gt; that no known effect explains.</source>
        <translation>&lt;b&gt;仍有残余&lt;/b&gt;，没有已知效应能解释。</translation>
    </message>
    <message>
        <source>&lt;b&gt;%1 is missing.&lt;/b&gt;</source>
        <translation>&lt;b&gt;遗漏了 %1。&lt;/b&gt;</translation>
    </message>
    <message>
        <source>Add &amp;curve…</source>
        <translation>添加曲线(&amp;C)…</translation>
    </message>
    <message>
        <source>A&amp;dd</source>
        <translation>添加(&amp;D)</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation>重新查找(&amp;L)</translation>
    </message>
    <message>
        <source>Adding it moves the extrinsic by %1.</source>
        <translation>添加后外参移动 %1。</translation>
    </message>
    <message>
        <source>its pattern is being drawn …</source>
        <translation>正在绘制其图样……</translation>
    </message>
    <message>
        <source>&lt;p&gt;In scenes held out, %1 % of the variance of the %2 residuals goes with %3 (%4 %5). No effect of the catalogue explains it: a smooth curve can stand in for it.&lt;/p&gt;</source>
        <translation>&lt;p&gt;在留出的场景中，%2 残差的方差有 %1 % 随 %3 变化（%4 %5）。目录中没有效应能解释它：可用平滑曲线代替。&lt;/p&gt;</translation>
    </message>
    <message>
        <source>What is missing</source>
        <translation>遗漏了什么</translation>
    </message>
    <message>
        <source>What cannot be seen</source>
        <translation>看不到什么</translation>
    </message>
    <message>
        <source>Effects that these scenes could not show, and by how much they would spoil the extrinsic at the size that matters</source>
        <translation>这些场景无法显示的效应，以及达到有影响的大小时会使外参偏离多少</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>效应</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>结论</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>误差</translation>
    </message>
    <message>
        <source>Could move by</source>
        <translation>可能移动</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>残留</translation>
    </message>
    <message>
        <source>Share of its squared effect that the poses leave</source>
        <translation>位姿吸收后剩下的平方效应份额</translation>
    </message>
    <message>
        <source>&amp;Find all</source>
        <translation>全部查找(&amp;F)</translation>
    </message>
    <message>
        <source>Add what scenes held out speak for, one after the other</source>
        <translation>逐个添加留出场景所支持的效应</translation>
    </message>
    <message>
        <source>Add the chosen effect to the model</source>
        <translation>把所选效应添加到模型</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ModelPage</name>
    <message>
        <source>Run the calibration to see what its model explains and what it misses.</source>
        <translation>运行标定，查看模型解释了什么、遗漏了什么。</translation>
    </message>
    <message>
        <source>noise</source>
        <translation>噪声</translation>
    </message>
    <message>
        <source>unexplained</source>
        <translation>未解释</translation>
    </message>
    <message>
        <source>explained</source>
        <translation>已解释</translation>
    </message>
    <message>
        <source>scenes held out</source>
        <translation>留出的场景</translation>
    </message>
    <message>
        <source>Steps: %1</source>
        <translation>步骤：%1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ModelWork</name>
    <message>
        <source>Cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>add %1</source>
        <translation>添加 %1</translation>
    </message>
    <message>
        <source>remove %1</source>
        <translation>移除 %1</translation>
    </message>
    <message>
        <source>switch %1 on</source>
        <translation>启用 %1</translation>
    </message>
    <message>
        <source>switch %1 off</source>
        <translation>停用 %1</translation>
    </message>
    <message>
        <source>hold %1</source>
        <translation>固定 %1</translation>
    </message>
    <message>
        <source>fit %1 again</source>
        <translation>重新拟合 %1</translation>
    </message>
    <message>
        <source>go to step %1</source>
        <translation>转到第 %1 步</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResidualMapPlot</name>
    <message>
        <source>Mean residual of each cell. Outlined: different from zero beyond chance, all cells taken together. Corners are arrows, enlarged.</source>
        <translation>每格的平均残差。带框：全部格子一并考虑，显著不为零。角点以放大的箭头表示。</translation>
    </message>
    <message>
        <source>only corners lie in the image</source>
        <translation>只有角点位于图像中</translation>
    </message>
    <message>
        <source>corners have no direction</source>
        <translation>角点没有方向</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>没有数据</translation>
    </message>
    <message>
        <source>mean residual (%1)</source>
        <translation>平均残差（%1）</translation>
    </message>
    <message>
        <source>longest arrow: %1 px</source>
        <translation>最长箭头：%1 px</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResidualPlot</name>
    <message>
        <source>Each residual (measured − predicted) as a dot, denser where there are more. Marks: means of groups with two standard deviations, filled where they differ from zero beyond chance. Dashed lines: the noise of a single residual. Grey: the means of the base model.</source>
        <translation>每个残差（测量 − 预测）为一点，越多越密。标记：分组均值及两倍标准差，显著不为零者填实。虚线：单个残差的噪声。灰色：基础模型的均值。</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>没有数据</translation>
    </message>
    <message>
        <source>residual (%1)</source>
        <translation>残差（%1）</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TermList</name>
    <message>
        <source>base model</source>
        <translation>基础模型</translation>
    </message>
    <message>
        <source>Pinhole camera, rigid board poses and one extrinsic</source>
        <translation>针孔相机、刚性标定板位姿和一个外参</translation>
    </message>
    <message>
        <source>Extrinsic moved by %1; it is known to %2.</source>
        <translation>外参移动了 %1；其已知精度为 %2。</translation>
    </message>
    <message>
        <source>Held: the value is yours and is not fitted</source>
        <translation>固定：采用您的值，不拟合</translation>
    </message>
    <message>
        <source>Value and standard deviation; believable: ±%1 %2. Double-click to hold it at a value of yours.</source>
        <translation>值与标准差；可信范围：±%1 %2。双击可固定为您的值。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Model&lt;/b&gt;</source>
        <translation>&lt;b&gt;模型&lt;/b&gt;</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>效应</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>值</translation>
    </message>
    <message>
        <source>Held</source>
        <translation>固定</translation>
    </message>
    <message>
        <source>Effects in the model</source>
        <translation>模型中的效应</translation>
    </message>
    <message>
        <source>&amp;Add…</source>
        <translation>添加(&amp;A)…</translation>
    </message>
    <message>
        <source>Add an effect of the catalogue, a formula or a curve</source>
        <translation>添加目录中的效应、公式或曲线</translation>
    </message>
    <message>
        <source>Re&amp;move</source>
        <translation>移除(&amp;M)</translation>
    </message>
    <message>
        <source>Take the chosen effect out of the model</source>
        <translation>把所选效应移出模型</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::WhatIfPane</name>
    <message>
        <source>no effect</source>
        <translation>无效应</translation>
    </message>
    <message>
        <source>Choose an effect to see, before it is in the model, what it would leave in the residuals (orange).</source>
        <translation>选择一个效应，在加入模型之前查看它会在残差中留下什么（橙色）。</translation>
    </message>
    <message>
        <source>Orange: what the poses would leave of it; %1 %2 is the size that matters.</source>
        <translation>橙色：位姿吸收后的残留；有影响的大小为 %1 %2。</translation>
    </message>
    <message>
        <source>&lt;b&gt;What if&lt;/b&gt;</source>
        <translation>&lt;b&gt;假如&lt;/b&gt;</translation>
    </message>
    <message>
        <source>Size of the effect</source>
        <translation>效应的大小</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::WherePane</name>
    <message>
        <source>all scenes</source>
        <translation>所有场景</translation>
    </message>
    <message>
        <source>no intensity in these clouds</source>
        <translation>这些点云没有强度</translation>
    </message>
    <message>
        <source>&amp;Channel</source>
        <translation>通道(&amp;C)</translation>
    </message>
    <message>
        <source>a&amp;gainst</source>
        <translation>对(&amp;G)</translation>
    </message>
    <message>
        <source>What the residuals may depend on, best first. The percentage is the share of the variance in scenes held out that a smooth curve of it explains.</source>
        <translation>残差可能依赖的量，最好的在前。百分比是其平滑曲线在留出场景中解释的方差份额。</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Dragging selects measurements, in all figures and in cloud and image of their scene</source>
        <translation>拖动以选择测量值，在所有图以及其场景的点云和图像中</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>之前</translation>
    </message>
    <message>
        <source>Show the means of the base model in grey</source>
        <translation>以灰色显示基础模型的均值</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>闪烁</translation>
    </message>
    <message>
        <source>Show measured and predicted in turns at the same place</source>
        <translation>在同一位置交替显示测量值和预测值</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>Directions</source>
        <translation>方向</translation>
    </message>
    <message>
        <source>Board intensity</source>
        <translation>板面强度</translation>
    </message>
</context>
</TS>
