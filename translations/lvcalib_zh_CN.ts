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
        <translation>项目的数据集已不在
%1
它现在在哪里？</translation>
    </message>
    <message>
        <source>Unsaved decisions found</source>
        <translation>发现未保存的决定</translation>
    </message>
    <message>
        <source>The program ended last time before your decisions about
%1
were saved. Take them up again?</source>
        <translation>程序上次结束时，您对
%1
所作的决定尚未保存。是否恢复？</translation>
    </message>
    <message>
        <source>Open a file with T_imu_lidar</source>
        <translation>打开包含 T_imu_lidar 的文件</translation>
    </message>
    <message>
        <source>YAML (*.yaml *.yml)</source>
        <translation>YAML (*.yaml *.yml)</translation>
    </message>
    <message>
        <source>Open a recording</source>
        <translation>打开记录</translation>
    </message>
    <message>
        <source>Recordings (*.bag *.mcap *.db3 metadata.yaml *.zstd *.zst *.lz4);;All files (*)</source>
        <translation>记录 (*.bag *.mcap *.db3 metadata.yaml *.zstd *.zst *.lz4);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Open a description of the board</source>
        <translation>打开标定板描述</translation>
    </message>
    <message>
        <source>Open a camera file</source>
        <translation>打开相机文件</translation>
    </message>
    <message>
        <source>Folder of the new dataset</source>
        <translation>新数据集的文件夹</translation>
    </message>
    <message>
        <source>Open a cloud</source>
        <translation>打开点云</translation>
    </message>
    <message>
        <source>Clouds (*.pcd *.ply)</source>
        <translation>点云 (*.pcd *.ply)</translation>
    </message>
    <message>
        <source>Open a folder of clouds</source>
        <translation>打开点云文件夹</translation>
    </message>
    <message>
        <source>Place of the corrected clouds</source>
        <translation>校正后点云的位置</translation>
    </message>
    <message>
        <source>Compare with</source>
        <translation>比较对象</translation>
    </message>
    <message>
        <source>Add scene folders (image and cloud each)</source>
        <translation>添加场景文件夹（各含图像与点云）</translation>
    </message>
    <message>
        <source>Open a folder of images and clouds</source>
        <translation>打开图像和点云的文件夹</translation>
    </message>
    <message>
        <source>Results and truths (*.json *.yaml)</source>
        <translation>结果与真值 (*.json *.yaml)</translation>
    </message>
    <message>
        <source>Open the description of a LiDAR</source>
        <translation>打开激光雷达描述文件</translation>
    </message>
    <message>
        <source>The result has failed</source>
        <translation>结果失败</translation>
    </message>
    <message>
        <source>This result has failed: it is not to be used, and its warnings say why.</source>
        <translation>该结果已失败：不应使用，原因见其警告。</translation>
    </message>
    <message>
        <source>Export it all the same</source>
        <translation>仍然导出</translation>
    </message>
    <message>
        <source>Add images of the board</source>
        <translation>添加标定板图像</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff)</source>
        <translation>图像 (*.png *.jpg *.jpeg *.bmp *.tif *.tiff)</translation>
    </message>
    <message>
        <source>Open a folder of images of the board</source>
        <translation>打开标定板图像文件夹</translation>
    </message>
</context>
<context>
    <name>CloudSceneText</name>
    <message>
        <source>Only the board&apos;s points are loaded.</source>
        <translation>仅载入了标定板上的点。</translation>
    </message>
    <message>
        <source>No board was found in this scene&apos;s cloud yet.</source>
        <translation>尚未在该场景的点云中找到标定板。</translation>
    </message>
    <message>
        <source>The cloud is not loaded yet.</source>
        <translation>点云尚未载入。</translation>
    </message>
    <message>
        <source>There are no boundary samples in this scene.</source>
        <translation>该场景没有边界样本。</translation>
    </message>
    <message>
        <source>No crop box is set: all points are shown.</source>
        <translation>未设置裁剪框：显示全部点。</translation>
    </message>
    <message>
        <source>Camera colours need an image and an extrinsic; intensity is shown.</source>
        <translation>相机颜色需要图像和外参；现显示强度。</translation>
    </message>
    <message>
        <source>camera colour (grey: not in the image)</source>
        <translation>相机颜色（灰色：不在图像内）</translation>
    </message>
    <message>
        <source>This cloud has no intensity; range is shown.</source>
        <translation>该点云没有强度；现显示距离。</translation>
    </message>
    <message>
        <source>The board&apos;s plane is not known in this scene; range is shown.</source>
        <translation>该场景的标定板平面未知；现显示距离。</translation>
    </message>
    <message>
        <source>height z (m)</source>
        <translation>高度 z (m)</translation>
    </message>
    <message>
        <source>range (m)</source>
        <translation>距离 (m)</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>There is no cloud: %1</source>
        <translation>没有点云：%1</translation>
    </message>
    <message>
        <source>This cloud has no line numbers; range is shown.</source>
        <translation>此点云没有线号；改为显示距离。</translation>
    </message>
    <message>
        <source>This cloud has no times; range is shown.</source>
        <translation>此点云没有时间；改为显示距离。</translation>
    </message>
    <message>
        <source>scan line</source>
        <translation>扫描线</translation>
    </message>
    <message>
        <source>time (ms)</source>
        <translation>时间 (ms)</translation>
    </message>
    <message>
        <source>scene, counted as in the dataset</source>
        <translation>场景（按数据集中的次序编号）</translation>
    </message>
    <message>
        <source>range beyond the model with its effects, mean over %1 mm (mm)</source>
        <translation>距离超出含效应模型的值，%1 mm 内平均 (mm)</translation>
    </message>
    <message>
        <source>range beyond the base model, mean over %1 mm (mm)</source>
        <translation>距离超出基础模型的值，%1 mm 内平均 (mm)</translation>
    </message>
    <message>
        <source>range beyond the board&apos;s plane, mean over %1 mm (mm)</source>
        <translation>超出标定板平面的距离，%1 mm 内平均 (mm)</translation>
    </message>
    <message>
        <source>scene</source>
        <translation>场景</translation>
    </message>
</context>
<context>
    <name>Core</name>
    <message>
        <source>result: %1</source>
        <translation>结果：%1</translation>
    </message>
    <message>
        <source>scene %1 is not used: %2</source>
        <translation>场景 %1 未使用：%2</translation>
    </message>
    <message>
        <source>only one usable scene: nothing to check the result against; take two or more</source>
        <translation>只有一个可用场景，无从检验结果；请采集两个或更多场景</translation>
    </message>
    <message>
        <source>only one usable scene: nothing to check the result against; take two or more; %1</source>
        <translation>只有一个可用场景，无从检验结果；请采集两个或更多场景；%1</translation>
    </message>
    <message>
        <source>scene %1 has the same image as scene %2: one of the two is not the scene&apos;s own</source>
        <translation>场景 %1 的图像与场景 %2 的相同：两者之一不属于其场景</translation>
    </message>
    <message>
        <source>scene %1 has the same cloud as scene %2: one of the two is not the scene&apos;s own</source>
        <translation>场景 %1 的点云与场景 %2 的相同：两者之一不属于其场景</translation>
    </message>
    <message>
        <source>%1 t = [%2] m, %3 t = [%4] m, %5 mm and %6 mrad apart: did a sensor move between scenes %7 and %8?</source>
        <translation>%1 t = [%2] m，%3 t = [%4] m，相差 %5 mm 和 %6 mrad：场景 %7 与 %8 之间是否有传感器移动过？</translation>
    </message>
    <message>
        <source>scenes %1 give</source>
        <translation>场景 %1 给出</translation>
    </message>
    <message>
        <source>scene %1 gives</source>
        <translation>场景 %1 给出</translation>
    </message>
    <message>
        <source>no image shows the tags of the right columns that target.yaml has: %1 would fit</source>
        <translation>没有图像显示 target.yaml 中右侧各列的标签：%1 则相符</translation>
    </message>
    <message>
        <source>no image shows the tags of the upper rows that target.yaml has: %1 would fit</source>
        <translation>没有图像显示 target.yaml 中上方各行的标签：%1 则相符</translation>
    </message>
    <message>
        <source>the tags do not lie where the target has them; they do with %1</source>
        <translation>标签不在标定板描述的位置上；若 %1 则相符</translation>
    </message>
    <message>
        <source>the image shows tags %1 of %2; the target has %3; all of them fit with %4</source>
        <translation>图像中有 %2 的标签 %1，标定板描述的是 %3；若 %4 则全部相符</translation>
    </message>
    <message>
        <source>the scenes determine only %1 of 6 directions of the extrinsic</source>
        <translation>这些场景只能确定外参 6 个方向中的 %1 个</translation>
    </message>
    <message>
        <source>the scenes leave the extrinsic open: ± %1 mm and ± %2 mrad along the worst axes; add scenes with the board turned differently</source>
        <translation>这些场景不足以确定外参：最差轴上为 ± %1 mm 和 ± %2 mrad；请增加标定板朝向不同的场景</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR measures it %1 % larger than target.yaml says; measure the print and correct tagSize</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达测得比 target.yaml 大 %1 %；请测量打印件并修正 tagSize</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR measures it %1 % smaller than target.yaml says; measure the print and correct tagSize</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达测得比 target.yaml 小 %1 %；请测量打印件并修正 tagSize</translation>
    </message>
    <message>
        <source>darker returns lie %1 mm farther than brighter ones: the LiDAR&apos;s range depends on the reflectivity, an effect is missing in the model</source>
        <translation>较暗的回波比较亮的回波远 %1 mm：激光雷达的测距与反射率有关，模型中缺少一个效应</translation>
    </message>
    <message>
        <source>darker returns lie %1 mm nearer than brighter ones: the LiDAR&apos;s range depends on the reflectivity, an effect is missing in the model</source>
        <translation>较暗的回波比较亮的回波近 %1 mm：激光雷达的测距与反射率有关，模型中缺少一个效应</translation>
    </message>
    <message>
        <source>scene %1: its board measures %2 % larger than in the other scenes: is it another print?</source>
        <translation>场景 %1：测得的标定板比其他场景大 %2 %：是另一张打印件吗？</translation>
    </message>
    <message>
        <source>scene %1: its board measures %2 % smaller than in the other scenes: is it another print?</source>
        <translation>场景 %1：测得的标定板比其他场景小 %2 %：是另一张打印件吗？</translation>
    </message>
    <message>
        <source>the halves of the scenes (%1) differ by %2 mm and %3 mrad, more than noise explains (χ² %4, at most %5): an effect is missing in the model, or one scene is off</source>
        <translation>两半场景（%1）相差 %2 mm 和 %3 mrad，超出噪声所能解释的范围（χ² %4，上限 %5）：模型中缺少一个效应，或某个场景有误</translation>
    </message>
    <message>
        <source>the joint solve puts the LiDAR %1 mm and %2 mrad from where the localized boards put it, more than both leave open: it may have locked onto another place of the print; add scenes with the board turned differently</source>
        <translation>联合求解得到的激光雷达位置与标定板定位结果相差 %1 mm 和 %2 mrad，超出两者的不确定度：可能锁定在了图案的另一处；请增加标定板朝向不同的场景</translation>
    </message>
    <message>
        <source>two scenes: a mistake in one of them could not be told from one in the other</source>
        <translation>只有两个场景：无法分辨错误出在哪一个</translation>
    </message>
    <message>
        <source>tag corners miss their model by %1 px: check the intrinsics and that the board is flat</source>
        <translation>标签角点偏离模型 %1 px：请检查内参以及标定板是否平整</translation>
    </message>
    <message>
        <source>the board is not found in any cloud, but it is if the lengths in target.yaml are %1</source>
        <translation>在任何点云中都找不到标定板，但若 target.yaml 中的长度%1，则可以找到</translation>
    </message>
    <message>
        <source>write them in metres: multiply each by %1</source>
        <translation>请用米书写：将每个长度乘以 %1</translation>
    </message>
    <message>
        <source>lengths are in metres</source>
        <translation>长度以米为单位</translation>
    </message>
    <message>
        <source>another assignment of the board is nearly as good (margin %1)</source>
        <translation>标定板的另一种对应几乎同样好（裕度 %1）</translation>
    </message>
    <message>
        <source>%1 is not determined: add scenes with the board turned differently</source>
        <translation>%1未确定：请增加标定板朝向不同的场景</translation>
    </message>
    <message>
        <source>%1 is known %2 times worse than the typical direction: %3</source>
        <translation>%1的精度比典型方向差 %2 倍：%3</translation>
    </message>
    <message>
        <source>translation along the camera&apos;s x axis</source>
        <translation>沿相机 x 轴的平移</translation>
    </message>
    <message>
        <source>translation along the camera&apos;s y axis</source>
        <translation>沿相机 y 轴的平移</translation>
    </message>
    <message>
        <source>translation along the camera&apos;s z axis</source>
        <translation>沿相机 z 轴的平移</translation>
    </message>
    <message>
        <source>rotation about the camera&apos;s x axis</source>
        <translation>绕相机 x 轴的旋转</translation>
    </message>
    <message>
        <source>rotation about the camera&apos;s y axis</source>
        <translation>绕相机 y 轴的旋转</translation>
    </message>
    <message>
        <source>rotation about the camera&apos;s z axis</source>
        <translation>绕相机 z 轴的旋转</translation>
    </message>
    <message>
        <source>add a scene much nearer or farther, to part it from the turn about y</source>
        <translation>增加一个近得多或远得多的场景，以便与绕 y 轴的旋转区分</translation>
    </message>
    <message>
        <source>add a scene much nearer or farther, to part it from the turn about x</source>
        <translation>增加一个近得多或远得多的场景，以便与绕 x 轴的旋转区分</translation>
    </message>
    <message>
        <source>add a scene with the board nearer and tilted</source>
        <translation>增加一个标定板更近且倾斜的场景</translation>
    </message>
    <message>
        <source>add a scene much nearer or farther, or high or low in the image</source>
        <translation>增加一个近得多或远得多、或位于图像上部或下部的场景</translation>
    </message>
    <message>
        <source>add a scene much nearer or farther, or far left or right in the image</source>
        <translation>增加一个近得多或远得多、或位于图像最左或最右的场景</translation>
    </message>
    <message>
        <source>add a scene with the board near the image&apos;s edge</source>
        <translation>增加一个标定板靠近图像边缘的场景</translation>
    </message>
    <message>
        <source>rejected by the user</source>
        <translation>已被用户剔除</translation>
    </message>
    <message>
        <source>not used</source>
        <translation>未使用</translation>
    </message>
    <message>
        <source>the board found in the cloud does not agree with the other scenes</source>
        <translation>点云中找到的标定板与其他场景不一致</translation>
    </message>
    <message>
        <source>the board is not found in the cloud (%1); the LiDAR sees past the place where the image has it: does the image belong to this cloud?</source>
        <translation>在点云中找不到标定板（%1）；激光雷达的视线穿过了图像中标定板所在的位置：图像与点云属于同一场景吗？</translation>
    </message>
    <message>
        <source>the board is not found in the cloud (%1); something nearer stands where the image has it: does the image belong to this cloud, or is the board hidden from the LiDAR?</source>
        <translation>在点云中找不到标定板（%1）；图像中标定板所在的位置之前有更近的物体：图像与点云属于同一场景吗？还是标定板被遮挡而激光雷达看不到？</translation>
    </message>
    <message>
        <source>the board is not found in the cloud (%1)</source>
        <translation>在点云中找不到标定板（%1）</translation>
    </message>
    <message>
        <source>not searched</source>
        <translation>未搜索</translation>
    </message>
    <message>
        <source>%1 flat patches of its size, best pattern correlation %2</source>
        <translation>%1 个同尺寸的平面片，最佳图案相关系数 %2</translation>
    </message>
    <message>
        <source>%1 flat patches of its size</source>
        <translation>%1 个同尺寸的平面片</translation>
    </message>
    <message>
        <source>the crop box holds no points</source>
        <translation>裁剪框内没有点</translation>
    </message>
    <message>
        <source>contradicts the other scenes by %1 mm and %2 mrad: did the board or the rig move between cloud and image?</source>
        <translation>与其他场景相差 %1 mm 和 %2 mrad：采集点云与图像之间标定板或设备是否移动过？</translation>
    </message>
    <message>
        <source>refinement did not settle within its iterations</source>
        <translation>精化在迭代次数内未收敛</translation>
    </message>
    <message>
        <source>only %1 of %2 circles usable; node %3: %4</source>
        <translation>%2 个圆中仅 %1 个可用；节点 %3：%4</translation>
    </message>
    <message>
        <source>only %1 of %2 circles usable</source>
        <translation>%2 个圆中仅 %1 个可用</translation>
    </message>
    <message>
        <source>used</source>
        <translation>已使用</translation>
    </message>
    <message>
        <source>too few samples</source>
        <translation>样本太少</translation>
    </message>
    <message>
        <source>contrast too weak for the noise</source>
        <translation>相对噪声对比度太弱</translation>
    </message>
    <message>
        <source>samples on one side of the edge only</source>
        <translation>样本只在边缘一侧</translation>
    </message>
    <message>
        <source>no crossing of the mid-level</source>
        <translation>未穿过中间强度</translation>
    </message>
    <message>
        <source>contradicts the other bins</source>
        <translation>与其他区间矛盾</translation>
    </message>
    <message>
        <source>too few samples: %1 inside and %2 outside the circle, at least %3 each needed</source>
        <translation>样本太少：圆内 %1 个，圆外 %2 个，各需至少 %3 个</translation>
    </message>
    <message>
        <source>no contrast between circle and paper</source>
        <translation>圆与纸面之间没有对比度</translation>
    </message>
    <message>
        <source>too few usable bins around the circle</source>
        <translation>圆周上可用的区间太少</translation>
    </message>
    <message>
        <source>centre too uncertain</source>
        <translation>圆心不确定度太大</translation>
    </message>
    <message>
        <source>not refined</source>
        <translation>未精化</translation>
    </message>
    <message>
        <source>not enough samples</source>
        <translation>样本不足</translation>
    </message>
    <message>
        <source>no contrast</source>
        <translation>没有对比度</translation>
    </message>
    <message>
        <source>intensity clipped</source>
        <translation>强度被截断</translation>
    </message>
    <message>
        <source>not refined: %1</source>
        <translation>未精化：%1</translation>
    </message>
    <message>
        <source>not enough samples: %1</source>
        <translation>样本不足：%1</translation>
    </message>
    <message>
        <source>no contrast: %1</source>
        <translation>没有对比度：%1</translation>
    </message>
    <message>
        <source>intensity clipped: %1 of the paper&apos;s samples at the highest value</source>
        <translation>强度被截断：纸面样本的 %1 处于最大值</translation>
    </message>
    <message>
        <source>intensity clipped: %1 of the circle&apos;s samples at the highest value</source>
        <translation>强度被截断：圆内样本的 %1 处于最大值</translation>
    </message>
    <message>
        <source>intensity clipped: %1 of the paper&apos;s samples at the lowest value</source>
        <translation>强度被截断：纸面样本的 %1 处于最小值</translation>
    </message>
    <message>
        <source>intensity clipped: %1 of the circle&apos;s samples at the lowest value</source>
        <translation>强度被截断：圆内样本的 %1 处于最小值</translation>
    </message>
    <message>
        <source>the cloud has no intensity</source>
        <translation>点云没有强度</translation>
    </message>
    <message>
        <source>the intensities about the circles show no transition from black to white</source>
        <translation>圆周围的强度没有由黑到白的过渡</translation>
    </message>
    <message>
        <source>the transitions about the circles have no common width</source>
        <translation>各圆周围的过渡没有共同的宽度</translation>
    </message>
    <message>
        <source>not enough samples for statistics: %1 in the overlap region, needed %2 around the circles</source>
        <translation>样本不足以统计：重叠区内 %1 个，圆周围需要 %2 个</translation>
    </message>
    <message>
        <source>no circle gives boundary samples: %1 (the first: %2)</source>
        <translation>没有圆给出边界样本：%1（第一个：%2）</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <translation>%1 × %2 </translation>
    </message>
    <message>
        <source>this board has no circles</source>
        <translation>该标定板没有圆</translation>
    </message>
    <message>
        <source>not enough scenes for a boundary response: none is in use</source>
        <translation>场景不足以计算边界响应：没有使用中的场景</translation>
    </message>
    <message>
        <source>not enough scenes for a comparison of halves: neither half alone determines the extrinsic</source>
        <translation>场景不足以比较两半：任何一半都无法单独确定外参</translation>
    </message>
    <message>
        <source>not enough scenes for a comparison of halves: %1 in use, %2 needed</source>
        <translation>场景不足以比较两半：使用中 %1 个，需要 %2 个</translation>
    </message>
    <message>
        <source>near/far</source>
        <translation>近/远</translation>
    </message>
    <message>
        <source>left/right</source>
        <translation>左/右</translation>
    </message>
    <message>
        <source>flat/tilted</source>
        <translation>正/斜</translation>
    </message>
    <message>
        <source>joint solve</source>
        <translation>联合求解</translation>
    </message>
    <message>
        <source>comparing scenes</source>
        <translation>比较各场景</translation>
    </message>
    <message>
        <source>other sizes of the board</source>
        <translation>尝试其他标定板尺寸</translation>
    </message>
    <message>
        <source>done</source>
        <translation>完成</translation>
    </message>
    <message>
        <source>scene %1</source>
        <translation>场景 %1</translation>
    </message>
    <message>
        <source>scene %1: %2</source>
        <translation>场景 %1：%2</translation>
    </message>
    <message>
        <source>A bin with fewer samples is refused.</source>
        <translation>样本更少的区间将被拒绝。</translation>
    </message>
    <message>
        <source>A circle with fewer overlap samples is left out.</source>
        <translation>重叠区样本更少的圆不予采用。</translation>
    </message>
    <message>
        <source>A direction known so many times worse than usual is called weak.</source>
        <translation>精度比通常差这么多倍的方向称为弱方向。</translation>
    </message>
    <message>
        <source>A position known worse than this is no result.</source>
        <translation>位置精度差于此值则不算结果。</translation>
    </message>
    <message>
        <source>A rotation known worse than this is no result.</source>
        <translation>旋转精度差于此值则不算结果。</translation>
    </message>
    <message>
        <source>A scene is left out if the rest fits so many times better without it.</source>
        <translation>若去掉某场景后其余场景的拟合好这么多倍，则将其剔除。</translation>
    </message>
    <message>
        <source>A tag or node farther off (in σ) is left out.</source>
        <translation>偏差更大（以 σ 计）的标签或节点将被剔除。</translation>
    </message>
    <message>
        <source>A tag that misses the board&apos;s pose by more is dropped.</source>
        <translation>偏离标定板位姿更多的标签将被丢弃。</translation>
    </message>
    <message>
        <source>Added in quadrature to every node&apos;s standard deviation.</source>
        <translation>以平方和方式加到每个节点的标准差上。</translation>
    </message>
    <message>
        <source>Added in quadrature to the plane&apos;s height.</source>
        <translation>以平方和方式加到平面高度的标准差上。</translation>
    </message>
    <message>
        <source>Angular bins of a densely sampled node.</source>
        <translation>样本密集的节点的角度区间数。</translation>
    </message>
    <message>
        <source>Angular bins of a sparsely sampled node.</source>
        <translation>样本稀疏的节点的角度区间数。</translation>
    </message>
    <message>
        <source>Chance of widening a stated σ though only noise is at work.</source>
        <translation>仅有噪声时误将 σ 放大的概率。</translation>
    </message>
    <message>
        <source>Closer points (the rig itself) are ignored.</source>
        <translation>更近的点（设备自身）被忽略。</translation>
    </message>
    <message>
        <source>Corner noise above this makes the result doubtful where no replicates tell it.</source>
        <translation>在没有重复观测说明噪声时，角点噪声超过此值则结果存疑。</translation>
    </message>
    <message>
        <source>Corner noise is never taken below this.</source>
        <translation>角点噪声不低于此值。</translation>
    </message>
    <message>
        <source>Done when no node moves by more.</source>
        <translation>所有节点的移动都不超过此值时结束。</translation>
    </message>
    <message>
        <source>Evidence by which the board assignment must win.</source>
        <translation>标定板对应必须胜出的证据量。</translation>
    </message>
    <message>
        <source>The search for missing effects adds no more than this.</source>
        <translation>搜索缺失效应时最多添加这么多个。</translation>
    </message>
    <message>
        <source>Chance that an effect which is not there is taken for one, over all candidates.</source>
        <translation>在所有候选中，把不存在的效应当作存在的概率。</translation>
    </message>
    <message>
        <source>Least fall of a channel&apos;s held-out squares that earns an effect its place.</source>
        <translation>效应入选所需的通道留出平方和的最小降幅。</translation>
    </message>
    <message>
        <source>The same with three scenes or fewer.</source>
        <translation>场景不超过三个时的同一数值。</translation>
    </message>
    <message>
        <source>Or the extrinsic moves by so many standard deviations.</source>
        <translation>或外参移动这么多个标准差。</translation>
    </message>
    <message>
        <source>Share of scenes that must be predicted better.</source>
        <translation>必须预测得更好的场景所占比例。</translation>
    </message>
    <message>
        <source>Scenes whose log-density changes by less say nothing.</source>
        <translation>对数密度变化小于此值的场景不作数。</translation>
    </message>
    <message>
        <source>Share of what a channel misses by, beyond its noise, that an effect must explain.</source>
        <translation>通道误差超出噪声时，效应必须解释的比例。</translation>
    </message>
    <message>
        <source>Effects correlated higher cannot be told apart.</source>
        <translation>相关性更高的效应无法区分。</translation>
    </message>
    <message>
        <source>Share of the held-out variance from which structure is named.</source>
        <translation>结构被指出所需占留出方差的比例。</translation>
    </message>
    <message>
        <source>The same where the scenes agree that it is no chance.</source>
        <translation>各场景一致表明并非偶然时的同一数值。</translation>
    </message>
    <message>
        <source>Height of something local, in standard deviations of one range, from which it is named.</source>
        <translation>局部结构被指出所需的高度，以单次测距的标准差为单位。</translation>
    </message>
    <message>
        <source>Fewer overlap samples give no statistics.</source>
        <translation>重叠区样本更少时不作统计。</translation>
    </message>
    <message>
        <source>Fewer tags make an image unusable.</source>
        <translation>标签更少的图像不可用。</translation>
    </message>
    <message>
        <source>Flatness of plane candidates; 0: from the measured noise.</source>
        <translation>候选平面的平整度；0：由测得的噪声决定。</translation>
    </message>
    <message>
        <source>Half-width of the overlap region in units of the transition&apos;s width.</source>
        <translation>重叠区的半宽，以过渡宽度为单位。</translation>
    </message>
    <message>
        <source>How far a rough extrinsic may be off.</source>
        <translation>粗略外参允许的平移偏差。</translation>
    </message>
    <message>
        <source>How far a rough extrinsic may be turned.</source>
        <translation>粗略外参允许的旋转偏差。</translation>
    </message>
    <message>
        <source>Huber threshold in standard deviations.</source>
        <translation>Huber 阈值，以标准差计。</translation>
    </message>
    <message>
        <source>Image reduction for the first tag search.</source>
        <translation>首次搜索标签时图像的缩小倍数。</translation>
    </message>
    <message>
        <source>Largest believable distance between camera and LiDAR.</source>
        <translation>相机与激光雷达之间可信的最大距离。</translation>
    </message>
    <message>
        <source>Largest correction of a node in one iteration.</source>
        <translation>一次迭代中节点的最大修正量。</translation>
    </message>
    <message>
        <source>Leave out scenes that contradict all others.</source>
        <translation>剔除与其他所有场景矛盾的场景。</translation>
    </message>
    <message>
        <source>LiDAR residuals this many times their σ make the result doubtful.</source>
        <translation>激光雷达残差达到其 σ 的这么多倍时结果存疑。</translation>
    </message>
    <message>
        <source>Use the clouds&apos; intensities; without them planes and corners have to do.</source>
        <translation>使用点云的强度；不用时只能依靠平面和角点。</translation>
    </message>
    <message>
        <source>Look for the pattern on planes larger than the board from the start.</source>
        <translation>从一开始就在大于标定板的平面上搜索图案。</translation>
    </message>
    <message>
        <source>Most iterations of one solve.</source>
        <translation>一次求解的最大迭代次数。</translation>
    </message>
    <message>
        <source>Most iterations.</source>
        <translation>最大迭代次数。</translation>
    </message>
    <message>
        <source>Pattern correlation below this is not the board.</source>
        <translation>图案相关系数低于此值则不是标定板。</translation>
    </message>
    <message>
        <source>Plane candidates examined at full density.</source>
        <translation>以全密度检查的候选平面数。</translation>
    </message>
    <message>
        <source>Range difference of dark and white print that makes the result doubtful.</source>
        <translation>黑白印刷区测距之差达到此值时结果存疑。</translation>
    </message>
    <message>
        <source>Rcl and Pcl of FAST-LIVO2, LiDAR to camera</source>
        <translation>FAST-LIVO2 的 Rcl 和 Pcl，激光雷达到相机</translation>
    </message>
    <message>
        <source>Share of a level at the end of the intensity scale that counts as clipped.</source>
        <translation>强度处于量程端点的比例达到此值视为截断。</translation>
    </message>
    <message>
        <source>Size difference between LiDAR and model worth a warning.</source>
        <translation>激光雷达测得尺寸与模型相差此值时发出警告。</translation>
    </message>
    <message>
        <source>Size difference that makes the result untrustworthy.</source>
        <translation>尺寸相差此值时结果不可信。</translation>
    </message>
    <message>
        <source>Smallest level difference in units of the intensity noise.</source>
        <translation>最小强度差，以强度噪声为单位。</translation>
    </message>
    <message>
        <source>Systematic rotation error allowed between scenes.</source>
        <translation>场景之间允许的系统性旋转误差。</translation>
    </message>
    <message>
        <source>Systematic translation error allowed between scenes.</source>
        <translation>场景之间允许的系统性平移误差。</translation>
    </message>
    <message>
        <source>T_camera_lidar, 4x4 numbers</source>
        <translation>T_camera_lidar，4x4 个数</translation>
    </message>
    <message>
        <source>Wanted samples per bin; decides how many bins a node gets.</source>
        <translation>每个区间期望的样本数；决定节点的区间数。</translation>
    </message>
    <message>
        <source>Width of the classes of incidence.</source>
        <translation>入射角分组的宽度。</translation>
    </message>
    <message>
        <source>Width of the classes of range.</source>
        <translation>距离分组的宽度。</translation>
    </message>
    <message>
        <source>calib.json of direct_visual_lidar_calibration, T_lidar_camera</source>
        <translation>direct_visual_lidar_calibration 的 calib.json，T_lidar_camera</translation>
    </message>
    <message>
        <source>camchain with T_cam_lidar</source>
        <translation>带 T_cam_lidar 的 camchain</translation>
    </message>
    <message>
        <source>camera_ext_R and camera_ext_t of R3LIVE, camera to IMU</source>
        <translation>R3LIVE 的 camera_ext_R 和 camera_ext_t，相机到 IMU</translation>
    </message>
    <message>
        <source>false alarm</source>
        <translation>误报概率</translation>
    </message>
    <message>
        <source>fixed joint, camera in LiDAR</source>
        <translation>固定关节，相机在激光雷达坐标系中</translation>
    </message>
    <message>
        <source>guess rotation</source>
        <translation>初值旋转偏差</translation>
    </message>
    <message>
        <source>guess translation</source>
        <translation>初值平移偏差</translation>
    </message>
    <message>
        <source>incidence bin</source>
        <translation>入射角分组</translation>
    </message>
    <message>
        <source>lidar_to_cam_* of LVI-SAM, LiDAR to x-forward camera</source>
        <translation>LVI-SAM 的 lidar_to_cam_*，激光雷达到 x 轴朝前的相机</translation>
    </message>
    <message>
        <source>max bins</source>
        <translation>最大区间数</translation>
    </message>
    <message>
        <source>max clipped share</source>
        <translation>最大截断比例</translation>
    </message>
    <message>
        <source>max dark offset</source>
        <translation>最大黑白距离差</translation>
    </message>
    <message>
        <source>max iterations</source>
        <translation>最大迭代次数</translation>
    </message>
    <message>
        <source>max lever arm</source>
        <translation>最大杆臂</translation>
    </message>
    <message>
        <source>max noise scale</source>
        <translation>最大噪声倍数</translation>
    </message>
    <message>
        <source>max patches</source>
        <translation>最大平面片数</translation>
    </message>
    <message>
        <source>max reprojection</source>
        <translation>最大重投影误差</translation>
    </message>
    <message>
        <source>max sigma</source>
        <translation>最大角点噪声</translation>
    </message>
    <message>
        <source>max sigma rotation</source>
        <translation>最大旋转标准差</translation>
    </message>
    <message>
        <source>max sigma translation</source>
        <translation>最大平移标准差</translation>
    </message>
    <message>
        <source>max step</source>
        <translation>最大步长</translation>
    </message>
    <message>
        <source>min bin samples</source>
        <translation>区间最少样本数</translation>
    </message>
    <message>
        <source>min bins</source>
        <translation>最小区间数</translation>
    </message>
    <message>
        <source>min contrast</source>
        <translation>最小对比度</translation>
    </message>
    <message>
        <source>min correlation</source>
        <translation>最小相关系数</translation>
    </message>
    <message>
        <source>min margin</source>
        <translation>最小裕度</translation>
    </message>
    <message>
        <source>min node samples</source>
        <translation>节点最少样本数</translation>
    </message>
    <message>
        <source>min range</source>
        <translation>最小距离</translation>
    </message>
    <message>
        <source>min samples</source>
        <translation>最少样本数</translation>
    </message>
    <message>
        <source>min tags</source>
        <translation>最少标签数</translation>
    </message>
    <message>
        <source>node sigma floor</source>
        <translation>节点标准差下限</translation>
    </message>
    <message>
        <source>noise of points at reflectivity edges, for SLAM front ends (YAML)</source>
        <translation>反射率边缘处点的噪声，供 SLAM 前端使用（YAML）</translation>
    </message>
    <message>
        <source>overlap sigmas</source>
        <translation>重叠区半宽</translation>
    </message>
    <message>
        <source>plane sigma floor</source>
        <translation>平面标准差下限</translation>
    </message>
    <message>
        <source>plane tolerance</source>
        <translation>平面容差</translation>
    </message>
    <message>
        <source>quad decimate</source>
        <translation>图像缩小倍数</translation>
    </message>
    <message>
        <source>range bin</source>
        <translation>距离分组</translation>
    </message>
    <message>
        <source>reject bad scenes</source>
        <translation>剔除不良场景</translation>
    </message>
    <message>
        <source>rejection gate</source>
        <translation>剔除门限</translation>
    </message>
    <message>
        <source>robust threshold</source>
        <translation>稳健阈值</translation>
    </message>
    <message>
        <source>rvec and tvec as cv::projectPoints takes them (FileStorage YAML)</source>
        <translation>cv::projectPoints 所用的 rvec 和 tvec（FileStorage YAML）</translation>
    </message>
    <message>
        <source>samples per bin</source>
        <translation>每区间样本数</translation>
    </message>
    <message>
        <source>scale failure</source>
        <translation>尺寸失败阈值</translation>
    </message>
    <message>
        <source>scale warning</source>
        <translation>尺寸警告阈值</translation>
    </message>
    <message>
        <source>scene rejection gain</source>
        <translation>场景剔除增益</translation>
    </message>
    <message>
        <source>search walls</source>
        <translation>搜索墙面</translation>
    </message>
    <message>
        <source>sensor_kit_calibration.yaml with camera_link (x forward)</source>
        <translation>带 camera_link（x 轴朝前）的 sensor_kit_calibration.yaml</translation>
    </message>
    <message>
        <source>sigma px floor</source>
        <translation>角点噪声下限</translation>
    </message>
    <message>
        <source>static_transform_publisher of ROS 1, camera in LiDAR</source>
        <translation>ROS 1 的 static_transform_publisher，相机在激光雷达坐标系中</translation>
    </message>
    <message>
        <source>static_transform_publisher of ROS 2, camera in LiDAR</source>
        <translation>ROS 2 的 static_transform_publisher，相机在激光雷达坐标系中</translation>
    </message>
    <message>
        <source>systematic rotation</source>
        <translation>系统性旋转误差</translation>
    </message>
    <message>
        <source>systematic translation</source>
        <translation>系统性平移误差</translation>
    </message>
    <message>
        <source>tolerance</source>
        <translation>收敛容差</translation>
    </message>
    <message>
        <source>weak direction ratio</source>
        <translation>弱方向比值</translation>
    </message>
    <message>
        <source>%1 in the overlap region, %2 on the circle, %3 on the paper; needed %4, %5 and %6</source>
        <translation>重叠区 %1 个，圆内 %2 个，纸面 %3 个；各需 %4、%5 和 %6 个</translation>
    </message>
    <message>
        <source>black %1, white %2, noise %3</source>
        <translation>黑 %1，白 %2，噪声 %3</translation>
    </message>
    <message>
        <source>Azimuth or elevation is read with a wrong scale.</source>
        <translation>方位角或仰角读数的比例有误。</translation>
    </message>
    <message>
        <source>Beam divergence</source>
        <translation>光束发散</translation>
    </message>
    <message>
        <source>Beams do not start at the origin of the frame, so that their direction error falls with the range.</source>
        <translation>光束并非从坐标系原点发出，因此方向误差随距离增大而减小。</translation>
    </message>
    <message>
        <source>Blooming</source>
        <translation>光晕</translation>
    </message>
    <message>
        <source>Board bow</source>
        <translation>标定板弯曲</translation>
    </message>
    <message>
        <source>Boundary bias</source>
        <translation>边界偏移</translation>
    </message>
    <message>
        <source>Bright print outshines its neighbourhood, so that edges move towards the dark side, the more the higher the contrast.</source>
        <translation>明亮的印刷区盖过邻近区域，使边缘向暗侧移动，对比度越高越明显。</translation>
    </message>
    <message>
        <source>Collimation and axis errors</source>
        <translation>准直与轴系误差</translation>
    </message>
    <message>
        <source>Corner bias</source>
        <translation>角点偏移</translation>
    </message>
    <message>
        <source>Crosstalk or phase measurement makes the range error a wave of the range.</source>
        <translation>串扰或相位测量使测距误差成为距离的波动函数。</translation>
    </message>
    <message>
        <source>Cyclic range error</source>
        <translation>周期性测距误差</translation>
    </message>
    <message>
        <source>Angle offsets of each line</source>
        <translation>各线角度偏移</translation>
    </message>
    <message>
        <source>Elliptic footprint</source>
        <translation>椭圆光斑</translation>
    </message>
    <message>
        <source>Encoder eccentricity</source>
        <translation>编码器偏心</translation>
    </message>
    <message>
        <source>Encoder lag</source>
        <translation>编码器滞后</translation>
    </message>
    <message>
        <source>Every laser has its own delay.</source>
        <translation>每个激光器都有各自的延迟。</translation>
    </message>
    <message>
        <source>Every laser points slightly elsewhere than its table says.</source>
        <translation>每个激光器的指向与其标称表略有差别。</translation>
    </message>
    <message>
        <source>Every range is off by the same amount, for example by the internal delay or a wrong zero point.</source>
        <translation>所有距离都偏差同一数值，例如由内部延迟或错误的零点引起。</translation>
    </message>
    <message>
        <source>Focal length or principal point differ from the intrinsics file.</source>
        <translation>焦距或主点与内参文件不同。</translation>
    </message>
    <message>
        <source>Glossy print shines when the beam hits it squarely.</source>
        <translation>光束垂直照射时，有光泽的印刷面会反光。</translation>
    </message>
    <message>
        <source>Image rows are exposed one after the other while the camera turns.</source>
        <translation>相机转动时，图像各行先后曝光。</translation>
    </message>
    <message>
        <source>Ink gain</source>
        <translation>油墨扩散</translation>
    </message>
    <message>
        <source>Ink spreads, so that every black edge moves outwards.</source>
        <translation>油墨扩散，使每条黑色边缘向外移动。</translation>
    </message>
    <message>
        <source>Intensity with range and incidence</source>
        <translation>强度随距离和入射角变化</translation>
    </message>
    <message>
        <source>Intrinsics error</source>
        <translation>内参误差</translation>
    </message>
    <message>
        <source>Lag of the intensity</source>
        <translation>强度滞后</translation>
    </message>
    <message>
        <source>Less light returns from far and slanted surfaces than the sensor corrects for, and every line has a gain of its own.</source>
        <translation>从远处和倾斜表面返回的光比传感器所补偿的更少，且每条线有各自的增益。</translation>
    </message>
    <message>
        <source>Motion during the scan</source>
        <translation>扫描期间的运动</translation>
    </message>
    <message>
        <source>Near-range error</source>
        <translation>近距误差</translation>
    </message>
    <message>
        <source>Non-linear intensity</source>
        <translation>强度非线性</translation>
    </message>
    <message>
        <source>Offset of the beam&apos;s origin</source>
        <translation>光束原点偏移</translation>
    </message>
    <message>
        <source>Offset of the receiver&apos;s view</source>
        <translation>接收视场偏移</translation>
    </message>
    <message>
        <source>Overlap of emitter and receiver is incomplete close to the sensor.</source>
        <translation>在传感器近处，发射与接收的视场重叠不完全。</translation>
    </message>
    <message>
        <source>Print scale</source>
        <translation>打印比例</translation>
    </message>
    <message>
        <source>Range error with incidence</source>
        <translation>测距误差随入射角变化</translation>
    </message>
    <message>
        <source>Range offset</source>
        <translation>测距偏移</translation>
    </message>
    <message>
        <source>Range offset of each line</source>
        <translation>各线测距偏移</translation>
    </message>
    <message>
        <source>Range pull at edges</source>
        <translation>边缘处测距牵引</translation>
    </message>
    <message>
        <source>Range scale</source>
        <translation>测距比例</translation>
    </message>
    <message>
        <source>Range walk</source>
        <translation>距离游走</translation>
    </message>
    <message>
        <source>Ranges are proportionally off: wrong clock frequency or refractive index.</source>
        <translation>距离按比例偏差：时钟频率或折射率有误。</translation>
    </message>
    <message>
        <source>Residual distortion</source>
        <translation>残余畸变</translation>
    </message>
    <message>
        <source>Rolling shutter</source>
        <translation>卷帘快门</translation>
    </message>
    <message>
        <source>Scale of the angles</source>
        <translation>角度比例</translation>
    </message>
    <message>
        <source>Specular lobe</source>
        <translation>镜面反射瓣</translation>
    </message>
    <message>
        <source>The LiDAR or the board moved while the scan was taken.</source>
        <translation>采集扫描时激光雷达或标定板有移动。</translation>
    </message>
    <message>
        <source>The angle is read a little before or after the pulse: the beam is shifted along its scan.</source>
        <translation>角度在脉冲之前或之后读取：光束沿扫描方向偏移。</translation>
    </message>
    <message>
        <source>The beam is not square to the turning axis, or the axis is tilted against the mirror.</source>
        <translation>光束与转轴不垂直，或转轴相对反射镜倾斜。</translation>
    </message>
    <message>
        <source>The board is not flat: it bends or twists.</source>
        <translation>标定板不平：弯曲或扭曲。</translation>
    </message>
    <message>
        <source>The corner detector is drawn outwards or inwards, seen from the tag&apos;s centre.</source>
        <translation>从标签中心看，角点检测结果向外或向内偏移。</translation>
    </message>
    <message>
        <source>The detector needs time to recover, so that edges move along the scan.</source>
        <translation>探测器需要恢复时间，使边缘沿扫描方向移动。</translation>
    </message>
    <message>
        <source>The footprint is wider along one axis of the LiDAR.</source>
        <translation>光斑沿激光雷达某一轴更宽。</translation>
    </message>
    <message>
        <source>The footprint stretches on a slanted surface and the echo with it.</source>
        <translation>光斑在倾斜表面上拉长，回波也随之展宽。</translation>
    </message>
    <message>
        <source>The intensity is collected beside the reported direction.</source>
        <translation>强度的采集方向偏离报告的方向。</translation>
    </message>
    <message>
        <source>The lens distorts differently than the intrinsics file says.</source>
        <translation>镜头畸变与内参文件所述不同。</translation>
    </message>
    <message>
        <source>The mid-level crossing lies outside or inside the printed edge everywhere.</source>
        <translation>中间强度的穿越点处处位于印刷边缘的外侧或内侧。</translation>
    </message>
    <message>
        <source>The print is larger or smaller than drawn, or not square.</source>
        <translation>打印件比图纸大或小，或不是正方形。</translation>
    </message>
    <message>
        <source>The range drifts while electronics warm up.</source>
        <translation>电子器件预热期间距离漂移。</translation>
    </message>
    <message>
        <source>The receiver compresses strong echoes, so that the middle between black and white is reached off the edge.</source>
        <translation>接收器压缩强回波，因此黑白之间的中间强度出现在偏离边缘处。</translation>
    </message>
    <message>
        <source>The scale disc of the encoder is not centred on the axis.</source>
        <translation>编码器的码盘与转轴不同心。</translation>
    </message>
    <message>
        <source>The zero of azimuth or elevation is off. It is the same as a turned LiDAR: part of the extrinsic by definition.</source>
        <translation>方位角或仰角的零位有偏差。这等同于激光雷达转动了一个角度：按定义属于外参的一部分。</translation>
    </message>
    <message>
        <source>Warm-up drift</source>
        <translation>预热漂移</translation>
    </message>
    <message>
        <source>Weak echoes cross the detection threshold later (or earlier), so that dark print reads a different range than white print.</source>
        <translation>弱回波更晚（或更早）越过检测阈值，使深色印刷区的测距与白色不同。</translation>
    </message>
    <message>
        <source>Zero of the angles</source>
        <translation>角度零位</translation>
    </message>
    <message>
        <source>a board below 1.5 m beside one beyond 3 m</source>
        <translation>1.5 m 以内和 3 m 以外各一块标定板</translation>
    </message>
    <message>
        <source>a board turned beyond 40 degrees</source>
        <translation>转角超过 40 度的标定板</translation>
    </message>
    <message>
        <source>a board turned beyond 50 degrees</source>
        <translation>转角超过 50 度的标定板</translation>
    </message>
    <message>
        <source>a board turned so that its range spans two periods</source>
        <translation>转动标定板使其距离跨越两个周期</translation>
    </message>
    <message>
        <source>boards all around the LiDAR</source>
        <translation>在激光雷达四周放置标定板</translation>
    </message>
    <message>
        <source>boards at several distances and angles</source>
        <translation>多个距离和角度的标定板</translation>
    </message>
    <message>
        <source>boards at several distances: a print error in mm shrinks with the distance, this does not</source>
        <translation>多个距离的标定板：以毫米计的打印误差随距离减小，而此效应不会</translation>
    </message>
    <message>
        <source>boards at the edges of the field of view</source>
        <translation>位于视场边缘的标定板</translation>
    </message>
    <message>
        <source>boards at two distances with the same print</source>
        <translation>同一打印件在两个距离处</translation>
    </message>
    <message>
        <source>boards below 2 m beside boards beyond 4 m</source>
        <translation>2 m 以内和 4 m 以外的标定板</translation>
    </message>
    <message>
        <source>boards high and low</source>
        <translation>高处和低处的标定板</translation>
    </message>
    <message>
        <source>boards in all corners of the image and at several distances</source>
        <translation>位于图像各角且距离不同的标定板</translation>
    </message>
    <message>
        <source>boards in the corners of the image</source>
        <translation>位于图像各角的标定板</translation>
    </message>
    <message>
        <source>boards near and far, strongly turned</source>
        <translation>远近不同且转角很大的标定板</translation>
    </message>
    <message>
        <source>boards square to the beam beside turned ones</source>
        <translation>正对光束和转动的标定板</translation>
    </message>
    <message>
        <source>boards that every line crosses</source>
        <translation>每条线都扫过的标定板</translation>
    </message>
    <message>
        <source>boards that every line crosses at several distances</source>
        <translation>在多个距离处每条线都扫过的标定板</translation>
    </message>
    <message>
        <source>boards turned to ±40 degrees</source>
        <translation>转到 ±40 度的标定板</translation>
    </message>
    <message>
        <source>circles at near and far distance</source>
        <translation>近处和远处的圆</translation>
    </message>
    <message>
        <source>circles far away</source>
        <translation>远处的圆</translation>
    </message>
    <message>
        <source>let the rig rest</source>
        <translation>让设备静止</translation>
    </message>
    <message>
        <source>let the rig rest; take a shorter scan</source>
        <translation>让设备静止；缩短扫描时间</translation>
    </message>
    <message>
        <source>measure a printed circle with a caliper</source>
        <translation>用卡尺测量打印的圆</translation>
    </message>
    <message>
        <source>measure the print with a ruler</source>
        <translation>用尺测量打印件</translation>
    </message>
    <message>
        <source>measure the printed board: a wrong print scale looks the same</source>
        <translation>测量打印的标定板：错误的打印比例看起来相同</translation>
    </message>
    <message>
        <source>measure the printed circles: print growth looks the same</source>
        <translation>测量打印的圆：油墨扩散看起来相同</translation>
    </message>
    <message>
        <source>none needed: turn the board by 90 degrees to confirm</source>
        <translation>无需：将标定板转 90 度即可确认</translation>
    </message>
    <message>
        <source>none: not defined apart from the extrinsic</source>
        <translation>无：无法与外参分开定义</translation>
    </message>
    <message>
        <source>prints of several greys, or a reflectance chart</source>
        <translation>多种灰度的打印件，或反射率色卡</translation>
    </message>
    <message>
        <source>prints of two contrasts, or distances with different footprints</source>
        <translation>两种对比度的打印件，或光斑不同的距离</translation>
    </message>
    <message>
        <source>repeat the first scene at the end</source>
        <translation>最后重复第一个场景</translation>
    </message>
    <message>
        <source>scans that cross edges in both directions</source>
        <translation>沿两个方向扫过边缘的扫描</translation>
    </message>
    <message>
        <source>scans that cross the board in several directions</source>
        <translation>沿多个方向扫过标定板的扫描</translation>
    </message>
    <message>
        <source>Where a beam is cut by an edge, its energy comes from one side of the footprint, which on a slanted board lies nearer or farther; 1 is what the power alone does in every scan.</source>
        <translation>光束被边缘切断时，能量只来自光斑的一侧，在倾斜的标定板上这一侧或近或远；1 是每次扫描中单由功率造成的大小。</translation>
    </message>
    <message>
        <source>%1 Found: %2. With it, scenes held out have %3 % less squared error in the %4 channel and the extrinsic moves by %5 mm and %6 mrad.</source>
        <translation>%1 结果：%2。加入后，留出场景在%4通道的平方误差减少 %3 %，外参移动 %5 mm 和 %6 mrad。</translation>
    </message>
    <message>
        <source>%1 In the model, held: %2.</source>
        <translation>%1 已在模型中，数值固定：%2。</translation>
    </message>
    <message>
        <source>%1 In the model: %2.</source>
        <translation>%1 已在模型中：%2。</translation>
    </message>
    <message>
        <source>Explains the same as %1, which is in the model: these scenes cannot tell the two apart. To tell: %2.</source>
        <translation>与模型中的 %1 解释同样的现象：这些场景无法区分二者。要区分需要：%2。</translation>
    </message>
    <message>
        <source>White and black print contradict each other about it: %1 of both together; something that depends on the print is at work.</source>
        <translation>白色与黑色印刷对它的结论相互矛盾：合在一起为 %1；起作用的是与印刷颜色有关的其他因素。</translation>
    </message>
    <message>
        <source>White and black return unlike shares of light as range and incidence change, which no effect explains; edges are found in these intensities and cannot tell: %1.</source>
        <translation>距离和入射角变化时，白色与黑色返回光的比例变化不同，且没有任何效应能解释；边缘是从这些强度中找到的，因此无法判断：%1。</translation>
    </message>
    <message>
        <source>It explains %1 % of what is wrong in the %2 channel: %3; something else is at work there.</source>
        <translation>它只解释了%2通道中误差的 %1 %：%3；那里另有原因。</translation>
    </message>
    <message>
        <source>What fits best is impossible: %1, while no device has less than %2; something else is at work.</source>
        <translation>拟合最好的数值不可能出现：%1，而任何设备都不会小于 %2；起作用的是其他因素。</translation>
    </message>
    <message>
        <source>Not testable: %1.</source>
        <translation>无法检验：%1。</translation>
    </message>
    <message>
        <source>no tags on this board</source>
        <translation>该标定板上没有标签</translation>
    </message>
    <message>
        <source>not defined: the same as a turn of the LiDAR frame, which is part of the extrinsic</source>
        <translation>没有定义：与激光雷达坐标系的转动相同，而后者属于外参</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; cannot be used: %2</source>
        <translation>无法使用效应“%1”：%2</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; is in the model already</source>
        <translation>效应“%1”已在模型中</translation>
    </message>
    <message>
        <source>there is no effect &apos;%1&apos;; did you mean &apos;%2&apos;?</source>
        <translation>没有效应“%1”；您是指“%2”吗？</translation>
    </message>
    <message>
        <source>there is no effect &apos;%1&apos;</source>
        <translation>没有效应“%1”</translation>
    </message>
    <message>
        <source>not enough scenes to look for effects: %1, three or more are needed to hold one out</source>
        <translation>场景不足，无法寻找效应：%1 个，需要三个或更多才能留出一个</translation>
    </message>
    <message>
        <source>take scenes at other distances and with the board turned differently</source>
        <translation>请在其他距离、以不同的标定板朝向采集场景</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: there is no channel &apos;%2&apos;; did you mean &apos;%3&apos;? (expected corner, range, boundary or intensity)</source>
        <translation>“%1”中：没有通道“%2”；您是指“%3”吗？（应为 corner、range、boundary 或 intensity）</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: there is no channel &apos;%2&apos; (expected corner, range, boundary or intensity)</source>
        <translation>“%1”中：没有通道“%2”（应为 corner、range、boundary 或 intensity）</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: there is no covariate &apos;%2&apos;; did you mean &apos;%3&apos;?</source>
        <translation>“%1”中：没有协变量“%2”；您是指“%3”吗？</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: there is no covariate &apos;%2&apos;</source>
        <translation>“%1”中：没有协变量“%2”</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: expected &apos;[low..high]&apos; or &apos;[1|2|3]&apos; after %2, found &apos;%3&apos;</source>
        <translation>“%1”中：%2 之后应为“[low..high]”或“[1|2|3]”，实为“%3”</translation>
    </message>
    <message>
        <source>&apos;%1&apos; has %2 covariates, expected one or two</source>
        <translation>“%1”有 %2 个协变量，应为一个或两个</translation>
    </message>
    <message>
        <source>&apos;%1&apos; names the same covariate twice</source>
        <translation>“%1”两次使用同一个协变量</translation>
    </message>
    <message>
        <source>&apos;%1&apos;: %2 is a label; a curve over two covariates needs two scales</source>
        <translation>“%1”：%2 是标签；两个协变量的曲面需要两个连续量</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not complete, expected &apos;%2&apos;, such as &apos;%3&apos;</source>
        <translation>“%1”不完整，应为“%2”，例如“%3”</translation>
    </message>
    <message>
        <source>in the formula &apos;%1&apos; at character %2: &apos;=&apos; assigns; expected an expression (write == to compare)</source>
        <translation>公式“%1”第 %2 个字符处：“=”是赋值；应为表达式（比较请写 ==）</translation>
    </message>
    <message>
        <source>in the formula &apos;%1&apos; at character %2: %3</source>
        <translation>公式“%1”第 %2 个字符处：%3</translation>
    </message>
    <message>
        <source>in the formula &apos;%1&apos;: there is no covariate &apos;%2&apos;; did you mean &apos;%3&apos;?</source>
        <translation>公式“%1”中：没有协变量“%2”；您是指“%3”吗？</translation>
    </message>
    <message>
        <source>in the formula &apos;%1&apos;: there is no covariate &apos;%2&apos;</source>
        <translation>公式“%1”中：没有协变量“%2”</translation>
    </message>
    <message>
        <source>in the formula &apos;%1&apos;: %2</source>
        <translation>公式“%1”中：%2</translation>
    </message>
    <message>
        <source>coefficients are single letters; this channel has %1</source>
        <translation>系数是单个字母；该通道有 %1</translation>
    </message>
    <message>
        <source>the formula &apos;%1&apos; has no free coefficient; expected one or more, such as a in &apos;a*range&apos;</source>
        <translation>公式“%1”没有自由系数；应有一个或多个，例如“a*range”中的 a</translation>
    </message>
    <message>
        <source>the formula &apos;%1&apos; has %2 values separated by commas, expected one</source>
        <translation>公式“%1”有 %2 个以逗号分隔的值，应为一个</translation>
    </message>
    <message>
        <source>the formula has %1 characters, expected at most %2</source>
        <translation>公式有 %1 个字符，最多为 %2 个</translation>
    </message>
    <message>
        <source>fitting the model</source>
        <translation>正在拟合模型</translation>
    </message>
    <message>
        <source>looking for structure</source>
        <translation>正在寻找结构</translation>
    </message>
    <message>
        <source>ranking effects, %1 in the model</source>
        <translation>正在对效应排序，模型中有 %1 个</translation>
    </message>
    <message>
        <source>ranking effects</source>
        <translation>正在对效应排序</translation>
    </message>
    <message>
        <source>judging effects</source>
        <translation>正在判断效应</translation>
    </message>
    <message>
        <source>collecting measurements</source>
        <translation>正在收集测量值</translation>
    </message>
    <message>
        <source>looking for the next scene</source>
        <translation>正在寻找下一个场景</translation>
    </message>
    <message>
        <source>corner</source>
        <translation>角点</translation>
    </message>
    <message>
        <source>range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>boundary</source>
        <translation>边界</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>alias correlation</source>
        <translation>别名相关性</translation>
    </message>
    <message>
        <source>max effects</source>
        <translation>最多效应数</translation>
    </message>
    <message>
        <source>min explained</source>
        <translation>最小解释比例</translation>
    </message>
    <message>
        <source>min extrinsic move</source>
        <translation>最小外参移动</translation>
    </message>
    <message>
        <source>min gain</source>
        <translation>最小增益</translation>
    </message>
    <message>
        <source>min gain few scenes</source>
        <translation>少场景时最小增益</translation>
    </message>
    <message>
        <source>min height</source>
        <translation>最小高度</translation>
    </message>
    <message>
        <source>min structure</source>
        <translation>最小结构</translation>
    </message>
    <message>
        <source>min sure structure</source>
        <translation>确定结构的最小值</translation>
    </message>
    <message>
        <source>scenes improved</source>
        <translation>改善场景比例</translation>
    </message>
    <message>
        <source>informative nats</source>
        <translation>作数阈值</translation>
    </message>
    <message>
        <source>Tried in the model it predicts scenes held out worse, or nothing is left of it: %1; too few of them show it, or something else does what it explains. To decide: %2.</source>
        <translation>放入模型后，它对留出场景的预测反而更差，或者它已所剩无几：%1；能显示它的场景太少，或者它所解释的现象另有原因。要判定需要：%2。</translation>
    </message>
    <message>
        <source>the model of every return could not be solved (%1): the extrinsic rests on nodes, planes and corners</source>
        <translation>无法求解全部回波的模型（%1）：外参仅依据圆心、平面和角点</translation>
    </message>
    <message>
        <source>the clouds&apos; intensity is missing or the same everywhere: the extrinsic rests on planes and corners, and the print does not hold it sideways</source>
        <translation>点云没有强度或强度处处相同：外参仅依据平面和角点，印刷图案无法约束其横向位置</translation>
    </message>
    <message>
        <source>the print has no contrast for this LiDAR: the extrinsic rests on planes and corners, and the print does not hold it sideways</source>
        <translation>该激光雷达看不出印刷图案的对比度：外参仅依据平面和角点，印刷图案无法约束其横向位置</translation>
    </message>
    <message>
        <source>the clouds&apos; intensities do not follow the target&apos;s print: the extrinsic rests on planes and corners, and the print does not hold it sideways; does target.yaml describe this board?</source>
        <translation>点云强度与标定板的印刷图案不符：外参仅依据平面和角点，印刷图案无法约束其横向位置；target.yaml 描述的是这块标定板吗？</translation>
    </message>
    <message>
        <source>the LiDAR sees %1 % of the board only: something covers it, or it is cut off</source>
        <translation>激光雷达只看到标定板的 %1 %：有物体遮挡，或标定板被截断</translation>
    </message>
    <message>
        <source>the intensities are saturated on part of the board: scene %1; lower the LiDAR&apos;s gain or print the white greyer</source>
        <translation>标定板部分区域的强度已饱和：场景 %1；请降低激光雷达增益，或将白色印得灰一些</translation>
    </message>
    <message>
        <source>ambiguous: another place of the print on the board fits the intensities of all scenes nearly as well (log-likelihood %1 less)</source>
        <translation>存在歧义：印刷图案在标定板上的另一位置对所有场景的强度拟合得几乎一样好（对数似然仅低 %1）</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR sees the print %1 % larger than target.yaml says; %2 would fit; measure the print</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达看到的印刷图案比 target.yaml 大 %1 %；%2 才相符；请测量打印件</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR sees the print %1 % smaller than target.yaml says; %2 would fit; measure the print</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达看到的印刷图案比 target.yaml 小 %1 %；%2 才相符；请测量打印件</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR sees the print %1 % as wide and %2 % as high as target.yaml says; %3 would fit; measure the print</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达看到的印刷图案宽为 target.yaml 的 %1 %，高为 %2 %；%3 才相符；请测量打印件</translation>
    </message>
    <message>
        <source>its checkerboard has black and white squares the other way round than in most scenes: is it another board, or is the image mirrored?</source>
        <translation>其棋盘格的黑白方格与大多数场景相反：是另一块标定板，还是图像被镜像了？</translation>
    </message>
    <message>
        <source>Done when the extrinsic moves by less of its σ.</source>
        <translation>外参的移动小于其 σ 的这一比例时结束。</translation>
    </message>
    <message>
        <source>How rarely chance alone may let errors that measurements share into the model.</source>
        <translation>仅凭偶然就把测量共有的误差纳入模型的概率上限。</translation>
    </message>
    <message>
        <source>Most iterations of the solve over all returns.</source>
        <translation>全部回波求解的最大迭代次数。</translation>
    </message>
    <message>
        <source>Returns and corners farther off (in σ) weigh less.</source>
        <translation>偏离更远（以 σ 计）的回波和角点权重降低。</translation>
    </message>
    <message>
        <source>Side of the patches over which the print may move as one.</source>
        <translation>印刷图案可整体移动的区块边长。</translation>
    </message>
    <message>
        <source>patch</source>
        <translation>区块</translation>
    </message>
    <message>
        <source>without scene %1 the extrinsic moves by %2 mm and %3 mrad, more than three of its standard deviations: did something move while that scene was taken?</source>
        <translation>去掉场景 %1 后外参移动 %2 mm 和 %3 mrad，超过其标准差的三倍：采集该场景时是否有物体移动？</translation>
    </message>
    <message>
        <source>the images contradict the standard deviations of the intrinsics: %1; calibrate the camera again, or use --intrinsics free</source>
        <translation>图像与内参的标准差矛盾：%1；请重新标定相机，或使用 --intrinsics free</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; with that freed the extrinsic moves by %2 mm and %3 mrad; calibrate the camera again, or use --intrinsics free</source>
        <translation>图像与内参矛盾：%1；将其放开后外参移动 %2 mm 和 %3 mrad；请重新标定相机，或使用 --intrinsics free</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; with that freed the extrinsic moves by %2 mm and %3 mrad, less than what matters</source>
        <translation>图像与内参矛盾：%1；将其放开后外参移动 %2 mm 和 %3 mrad，无关紧要</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; calibrate the camera again, or use --intrinsics free</source>
        <translation>图像与内参矛盾：%1；请重新标定相机，或使用 --intrinsics free</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1, less than what matters</source>
        <translation>图像与内参矛盾：%1，无关紧要</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1</source>
        <translation>图像与内参矛盾：%1</translation>
    </message>
    <message>
        <source>the circles&apos; centres miss the model by more than their radius: the clouds do not show them</source>
        <translation>圆心偏离模型超过其半径：点云中看不到这些圆</translation>
    </message>
    <message>
        <source>the same files as scene %1, which counts once</source>
        <translation>与场景 %1 的文件相同，只计一次</translation>
    </message>
    <message>
        <source>its image and that of scene %1 seem to be exchanged: the scenes agree if they are</source>
        <translation>其图像似乎与场景 %1 的图像互换了：换回后各场景一致</translation>
    </message>
    <message>
        <source>the rough extrinsic (rig.yaml or --init) contradicts the scenes and was left out: %1</source>
        <translation>粗略外参（rig.yaml 或 --init）与场景矛盾，已不采用：%1</translation>
    </message>
    <message>
        <source>Too small to matter: %1; it moves the extrinsic by %2 mm and %3 mrad at most.</source>
        <translation>太小，无关紧要：%1；至多使外参移动 %2 mm 和 %3 mrad。</translation>
    </message>
    <message>
        <source>A fault that moves the LiDAR by less does not matter.</source>
        <translation>使激光雷达移动更小的误差无关紧要。</translation>
    </message>
    <message>
        <source>A fault that turns the extrinsic by less does not matter.</source>
        <translation>使外参旋转更小的误差无关紧要。</translation>
    </message>
    <message>
        <source>How rarely right intrinsics may be taken for contradicted.</source>
        <translation>正确的内参被误判为矛盾的概率上限。</translation>
    </message>
    <message>
        <source>The camera&apos;s intrinsics: 0 taken as given, 1 estimated with the standard deviations in camera.yaml, 2 estimated freely.</source>
        <translation>相机内参：0 按给定值，1 以 camera.yaml 中的标准差估计，2 自由估计。</translation>
    </message>
    <message>
        <source>mode</source>
        <translation>模式</translation>
    </message>
    <message>
        <source>these scenes cannot verify the camera&apos;s intrinsics; most open is the %1 would tell</source>
        <translation>这些场景无法验证相机内参；最不确定的是%1即可判断</translation>
    </message>
    <message>
        <source>focal length: a scene with the board tilted by 40° or more and one at twice the distance</source>
        <translation>焦距：增加一个标定板倾斜 40° 以上的场景和一个两倍距离处的场景</translation>
    </message>
    <message>
        <source>principal point: scenes with the board tilted, and rolled by 90° against each other</source>
        <translation>主点：增加标定板倾斜且彼此旋转 90° 的场景</translation>
    </message>
    <message>
        <source>distortion: scenes with the board in the corners of the image</source>
        <translation>畸变：增加标定板位于图像四角的场景</translation>
    </message>
    <message>
        <source>%1 in scene %2: planes and corners are used there; does target.yaml describe this board?</source>
        <translation>场景 %2 中%1：该处使用平面和角点；target.yaml 描述的是这块标定板吗？</translation>
    </message>
    <message>
        <source>%1 in scene %2: planes and corners are used there</source>
        <translation>场景 %2 中%1：该处使用平面和角点</translation>
    </message>
    <message>
        <source>the clouds&apos; intensity is missing or the same everywhere</source>
        <translation>点云缺少强度或强度处处相同</translation>
    </message>
    <message>
        <source>the print has no contrast for this LiDAR</source>
        <translation>印刷图案对该激光雷达没有对比度</translation>
    </message>
    <message>
        <source>the clouds&apos; intensities do not follow the target&apos;s print</source>
        <translation>点云强度与标定板图案不符</translation>
    </message>
    <message>
        <source>Nor does one that moves it by fewer standard deviations.</source>
        <translation>也不包括使其移动少于这么多个标准差的误差。</translation>
    </message>
    <message>
        <source>tolerance sigmas</source>
        <translation>容差（标准差）</translation>
    </message>
    <message>
        <source>use intensity</source>
        <translation>使用强度</translation>
    </message>
    <message>
        <source>ranges miss the model by %1 times their noise: another effect is missing in the model</source>
        <translation>距离与模型的偏差为其噪声的 %1 倍：模型中还缺少另一种效应</translation>
    </message>
    <message>
        <source>the %1 channel shows structure over %2 that no effect of the model explains; it could move the extrinsic by %3 mm and %4 mrad</source>
        <translation>%1通道随%2呈现出模型中任何效应都无法解释的结构；它可能使外参移动 %3 mm 和 %4 mrad</translation>
    </message>
    <message>
        <source>%1 Found: %2; %3 = %4; leaving it out would move the extrinsic by %5 mm and %6 mrad.</source>
        <translation>%1 结果：%2；%3 = %4；不计入它会使外参移动 %5 mm 和 %6 mrad。</translation>
    </message>
    <message>
        <source>%1 Found: %2; leaving it out would move the extrinsic by %3 mm and %4 mrad.</source>
        <translation>%1 结果：%2；不计入它会使外参移动 %3 mm 和 %4 mrad。</translation>
    </message>
    <message>
        <source>it runs from %1 to %2 over %3, known to %4</source>
        <translation>在 %3 上从 %1 变到 %2，不确定度 %4</translation>
    </message>
    <message>
        <source>period (m)</source>
        <translation>周期（m）</translation>
    </message>
    <message>
        <source>decay length (m)</source>
        <translation>衰减长度（m）</translation>
    </message>
    <message>
        <source>exponent (2 more: power by range and incidence)</source>
        <translation>指数（另有两个：功率随距离和入射角的变化）</translation>
    </message>
    <message>
        <source>decay (share of the session)</source>
        <translation>衰减（占采集时段的比例）</translation>
    </message>
    <message>
        <source>width s (rad)</source>
        <translation>宽度 s（rad）</translation>
    </message>
    <message>
        <source>scene %1 is used all the same, as you decided, though %2</source>
        <translation>场景 %1 按您的决定仍被采用，尽管：%2</translation>
    </message>
    <message>
        <source>scenes held out speak for an effect that the model lacks: %1</source>
        <translation>留出场景表明模型缺少一种效应：%1</translation>
    </message>
    <message>
        <source>misses the board&apos;s pose by %1 mm, more than the gate</source>
        <translation>偏离标定板位姿 %1 mm，超出门限</translation>
    </message>
    <message>
        <source>misses the board&apos;s pose by more than the gate</source>
        <translation>偏离标定板位姿，超出门限</translation>
    </message>
    <message>
        <source>no scene can be used; scene %1: %2</source>
        <translation>没有可用的场景；场景 %1：%2</translation>
    </message>
    <message>
        <source>this folder is no dataset; a dataset holds target.yaml (the board), camera.yaml (the intrinsics) and scenes/NAME/ with image.png and cloud.pcd for every scene</source>
        <translation>此文件夹不是数据集；数据集包含 target.yaml（标定板）、camera.yaml（内参），以及每个场景的 scenes/NAME/，其中有 image.png 和 cloud.pcd</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is no name of a frame; expected letters, digits and _ - . /, not beginning with - and without --</source>
        <translation>“%1”不是坐标系名称；只能用字母、数字和 _ - . /，不能以 - 开头，也不能含 --</translation>
    </message>
    <message>
        <source>as the robot&apos;s description calls it: velodyne, camera_left</source>
        <translation>按机器人描述文件中的名称：velodyne、camera_left</translation>
    </message>
    <message>
        <source>no edges of the print in the returns</source>
        <translation>回波中没有印刷图案的边缘</translation>
    </message>
    <message>
        <source>measured with the base model, as the beam&apos;s blur</source>
        <translation>已在基础模型中作为光束模糊测得</translation>
    </message>
    <message>
        <source>the joint solve over every return failed: nothing to look for effects with</source>
        <translation>基于全部回波的联合求解失败：无从寻找效应</translation>
    </message>
    <message>
        <source>see the warnings of the calibration</source>
        <translation>请参阅标定的警告</translation>
    </message>
    <message>
        <source>A wide beam blurs every edge of the print, the more the farther.</source>
        <translation>较宽的光束使印刷图案的每条边缘变模糊，距离越远越明显。</translation>
    </message>
    <message>
        <source>rig and board stand still for %1 s</source>
        <translation>传感器与标定板静止 %1 s</translation>
    </message>
    <message>
        <source>stands still for %1 s only; %2 s are needed</source>
        <translation>仅静止 %1 s；需要 %2 s</translation>
    </message>
    <message>
        <source>no sweep was recorded in this time</source>
        <translation>这段时间内没有记录到扫描</translation>
    </message>
    <message>
        <source>the images stand still, but the clouds change meanwhile</source>
        <translation>图像静止，但点云在变化</translation>
    </message>
    <message>
        <source>stands still, but was left out by its time</source>
        <translation>静止，但未按时间选用</translation>
    </message>
    <message>
        <source>the board is not found in its image: %1</source>
        <translation>图像中找不到标定板：%1</translation>
    </message>
    <message>
        <source>its image cannot be read again</source>
        <translation>其图像无法再次读取</translation>
    </message>
    <message>
        <source>none of its sweeps can be read</source>
        <translation>其扫描均无法读取</translation>
    </message>
    <message>
        <source>no CameraInfo was recorded; give a camera file (--camera) for the intrinsics</source>
        <translation>没有记录 CameraInfo；请用相机文件（--camera）给出内参</translation>
    </message>
    <message>
        <source>no CameraInfo was recorded for %1; put a camera.yaml into the dataset before it is calibrated</source>
        <translation>没有为 %1 记录 CameraInfo；标定前请把 camera.yaml 放入数据集</translation>
    </message>
    <message>
        <source>%1; put a camera.yaml into the dataset before it is calibrated</source>
        <translation>%1；标定前请把 camera.yaml 放入数据集</translation>
    </message>
    <message>
        <source>%1: holds no intrinsics</source>
        <translation>%1：不含内参</translation>
    </message>
    <message>
        <source>%1: clouds have no intensity; the calibration will rest on planes and corners alone</source>
        <translation>%1：点云没有强度；标定将只依靠平面和角点</translation>
    </message>
    <message>
        <source>%1: its images change their size; calibrate takes those of the camera&apos;s size</source>
        <translation>%1：图像尺寸有变化；标定只采用与相机尺寸相同的图像</translation>
    </message>
    <message>
        <source>%1: is taken for rectified; camera.yaml holds the intrinsics of rectified images, without distortion</source>
        <translation>%1：视为已校正的图像；camera.yaml 保存校正图像的内参，不含畸变</translation>
    </message>
    <message>
        <source>%1: %2 messages a second; motion between them cannot be seen</source>
        <translation>%1：每秒 %2 条消息；看不到其间的运动</translation>
    </message>
    <message>
        <source>%1: %2 messages cannot be read and are left out, the first because: %3</source>
        <translation>%1：%2 条消息无法读取，已略去；第一条的原因：%3</translation>
    </message>
    <message>
        <source>%1: %2 message only</source>
        <translation>%1：只有 %2 条消息</translation>
    </message>
    <message>
        <source>%1: %2 messages only</source>
        <translation>%1：只有 %2 条消息</translation>
    </message>
    <message>
        <source>the clocks of camera and LiDAR differ by %1; the times at which messages were recorded are used instead</source>
        <translation>相机与激光雷达的时钟相差 %1；改用消息的记录时刻</translation>
    </message>
    <message>
        <source>images and clouds were never recorded at the same time</source>
        <translation>图像与点云从未同时记录</translation>
    </message>
    <message>
        <source>no scene shows the default board, which target.yaml describes; put the description of yours in its place, or import with --target</source>
        <translation>没有场景显示 target.yaml 所描述的默认标定板；请换成您的标定板描述，或用 --target 导入</translation>
    </message>
    <message>
        <source>%1: has no metadata.yaml; its %2 files are read as one recording</source>
        <translation>%1：没有 metadata.yaml；其中的 %2 个文件作为一份记录读取</translation>
    </message>
    <message>
        <source>%1: named in metadata.yaml and not there; left out</source>
        <translation>%1：metadata.yaml 中列出但不存在；已略去</translation>
    </message>
    <message>
        <source>%1: has no index (its recording was not ended in good order); read through instead, as far as whole messages go</source>
        <translation>%1：没有索引（记录未正常结束）；改为从头读取，直到最后一条完整的消息</translation>
    </message>
    <message>
        <source>%1: its index is missing or damaged; read through instead, as far as whole messages go</source>
        <translation>%1：索引缺失或损坏；改为从头读取，直到最后一条完整的消息</translation>
    </message>
    <message>
        <source>%1: has no end (its recording was not ended in good order, or it is cut off); read through instead, as far as whole messages go</source>
        <translation>%1：没有结尾（记录未正常结束，或被截断）；改为从头读取，直到最后一条完整的消息</translation>
    </message>
    <message>
        <source>%1: is damaged or cut off at byte %2 of %3</source>
        <translation>%1：在第 %2 字节（共 %3）处损坏或被截断</translation>
    </message>
    <message>
        <source>%1: is cut off within the record at byte %2</source>
        <translation>%1：在第 %2 字节的数据记录内被截断</translation>
    </message>
    <message>
        <source>%1: is damaged or cut off within the record at byte %2 of %3</source>
        <translation>%1：在第 %2 字节（共 %3）的数据记录内损坏或被截断</translation>
    </message>
    <message>
        <source>%1: is damaged or cut off; the messages that can be read are read</source>
        <translation>%1：损坏或被截断；读取其中可读的消息</translation>
    </message>
    <message>
        <source>%1: the chunk at byte %2 is damaged or cut off; %3 messages of it are read</source>
        <translation>%1：第 %2 字节处的数据块损坏或被截断；读取其中的 %3 条消息</translation>
    </message>
    <message>
        <source>%1: the times of its messages go back; some are read out of order</source>
        <translation>%1：消息的时刻有倒退；部分消息的读取次序有误</translation>
    </message>
    <message>
        <source>%1: its compressed data are damaged or cut off; the part before is read</source>
        <translation>%1：压缩数据损坏或被截断；读取之前的部分</translation>
    </message>
    <message>
        <source>%1: %2 compressed messages are damaged; left out</source>
        <translation>%1：%2 条压缩消息已损坏；已略去</translation>
    </message>
    <message>
        <source>the ROS 1 bag ends within its header</source>
        <translation>ROS 1 bag 在文件头内中断</translation>
    </message>
    <message>
        <source>copy or record it again</source>
        <translation>请重新复制或重新记录</translation>
    </message>
    <message>
        <source>is a ROS 1 bag of version %1; expected 2.0</source>
        <translation>是版本 %1 的 ROS 1 bag；应为 2.0</translation>
    </message>
    <message>
        <source>convert it with &apos;rosbag fix&apos; or &apos;rosbag migrate&apos; of ROS 1</source>
        <translation>请用 ROS 1 的“rosbag fix”或“rosbag migrate”转换</translation>
    </message>
    <message>
        <source>the rosbag2 database cannot be read: %1</source>
        <translation>无法读取 rosbag2 数据库：%1</translation>
    </message>
    <message>
        <source>it needs rosbag2&apos;s tables topics and messages; copy the file again</source>
        <translation>需要 rosbag2 的话题表和消息表；请重新复制文件</translation>
    </message>
    <message>
        <source>is empty, expected a recording</source>
        <translation>为空，应为一份记录</translation>
    </message>
    <message>
        <source>is no recording that can be read; expected a ROS 1 bag (.bag), a rosbag2 folder, or one of its files (.db3, .mcap)</source>
        <translation>不是可读取的记录；应为 ROS 1 bag（.bag）、rosbag2 文件夹，或其中的文件（.db3、.mcap）</translation>
    </message>
    <message>
        <source>what matters is the file&apos;s content, not its name</source>
        <translation>起作用的是文件内容，而不是文件名</translation>
    </message>
    <message>
        <source>is a folder without a recording; expected metadata.yaml, or .db3, .mcap or .bag files</source>
        <translation>是没有记录的文件夹；应有 metadata.yaml，或 .db3、.mcap、.bag 文件</translation>
    </message>
    <message>
        <source>a folder of scenes needs no import: lvcalib calibrate takes it</source>
        <translation>场景文件夹无需导入：可直接标定</translation>
    </message>
    <message>
        <source>%1: holds no messages</source>
        <translation>%1：不含消息</translation>
    </message>
    <message>
        <source>holds no messages</source>
        <translation>不含消息</translation>
    </message>
    <message>
        <source>holds no images (sensor_msgs/Image or CompressedImage)</source>
        <translation>不含图像（sensor_msgs/Image 或 CompressedImage）</translation>
    </message>
    <message>
        <source>holds no clouds (sensor_msgs/PointCloud2 or Livox CustomMsg)</source>
        <translation>不含点云（sensor_msgs/PointCloud2 或 Livox CustomMsg）</translation>
    </message>
    <message>
        <source>play it through %1 and record what comes out</source>
        <translation>请经 %1 回放并记录其输出</translation>
    </message>
    <message>
        <source>none of its images can be read: %1</source>
        <translation>其图像均无法读取：%1</translation>
    </message>
    <message>
        <source>none of its clouds can be read: %1</source>
        <translation>其点云均无法读取：%1</translation>
    </message>
    <message>
        <source>rig and board never stand still: something moves in images or clouds all the time</source>
        <translation>传感器与标定板从未静止：图像或点云中始终有物体在动</translation>
    </message>
    <message>
        <source>let everything rest for two seconds or more at each board pose</source>
        <translation>请在每个标定板位姿静止两秒或更久</translation>
    </message>
    <message>
        <source>none of its %1 still stretches can be used; that from %2 s to %3 s: %4</source>
        <translation>其 %1 个静止时段均不可用；其中 %2 s 到 %3 s：%4</translation>
    </message>
    <message>
        <source>exists already</source>
        <translation>已存在</translation>
    </message>
    <message>
        <source>exists already and is no import</source>
        <translation>已存在，且不是导入的数据集</translation>
    </message>
    <message>
        <source>choose another name, or replace it with --force</source>
        <translation>请换一个名称，或勾选替换</translation>
    </message>
    <message>
        <source>choose another name</source>
        <translation>请换一个名称</translation>
    </message>
    <message>
        <source>is no name for a dataset folder</source>
        <translation>不能作为数据集文件夹的名称</translation>
    </message>
    <message>
        <source>holds no extrinsic; expected T_camera_lidar (a result) or T_CL (a truth)</source>
        <translation>不含外参；应有 T_camera_lidar（结果）或 T_CL（真值）</translation>
    </message>
    <message>
        <source>give the result.json of a calibration</source>
        <translation>请给出标定的 result.json</translation>
    </message>
    <message>
        <source>%1: has no metadata.yaml; its %2 file is read</source>
        <translation>%1：没有 metadata.yaml；读取其中的 %2 个文件</translation>
    </message>
    <message>
        <source>holds no %1 but raw packets: %2</source>
        <translation>不含%1，只有原始数据包：%2</translation>
    </message>
    <message>
        <source>images</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>clouds</source>
        <translation>点云</translation>
    </message>
    <message>
        <source>decay (s)</source>
        <translation>衰减时间（秒）</translation>
    </message>
    <message>
        <source>Drift within a scan</source>
        <translation>扫描内的漂移</translation>
    </message>
    <message>
        <source>The range drifts anew in every scan, as where the device is switched on for it.</source>
        <translation>每次扫描中测距都会重新漂移，例如设备仅在扫描时才通电。</translation>
    </message>
    <message>
        <source>let the device run before the scan; boards beside the middle, where motion looks different</source>
        <translation>扫描前让设备先运行一段时间；把标定板放在视场中央两侧，那里运动的表现与之不同</translation>
    </message>
    <message>
        <source>left out by the user</source>
        <translation>用户手动排除</translation>
    </message>
    <message>
        <source>too few tags: the others are left out by the user</source>
        <translation>标签太少：其余标签已被用户排除</translation>
    </message>
    <message>
        <source>there is no calibration yet</source>
        <translation>尚无标定结果</translation>
    </message>
    <message>
        <source>Not there as far as it matters: %1; it moves the extrinsic by %2 mm and %3 mrad at most.</source>
        <translation>就其影响而言不存在：%1；它最多使外参移动 %2 mm 和 %3 mrad。</translation>
    </message>
    <message>
        <source>Cannot be told from these scenes: %1; it may move the extrinsic by %2 mm and %3 mrad. To see it: %4.</source>
        <translation>这些场景无法判断：%1；它可能使外参移动 %2 mm 和 %3 mrad。要看到它：%4。</translation>
    </message>
    <message>
        <source>Undecided: %1 is neither excluded nor confirmed by scenes held out; it may move the extrinsic by %2 mm and %3 mrad. To decide: %4.</source>
        <translation>未定：%1 既未被留出的场景排除，也未被证实；它可能使外参移动 %2 mm 和 %3 mrad。要判定：%4。</translation>
    </message>
    <message>
        <source>key &apos;%1&apos; is missing; expected %2</source>
        <translation>缺少键“%1”；应为%2</translation>
    </message>
    <message>
        <source>is &apos;%1&apos; a misspelling of it?</source>
        <translation>“%1”是否为它的误拼？</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be between %2 and %3, found %4</source>
        <translation>“%1”必须在 %2 与 %3 之间，实际为 %4</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be at least %2, found %3</source>
        <translation>“%1”至少应为 %2，实际为 %3</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be at most %2, found %3</source>
        <translation>“%1”至多为 %2，实际为 %3</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a number, found %2</source>
        <translation>“%1”必须是数字，实际为 %2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a whole number, found %2</source>
        <translation>“%1”必须是整数，实际为 %2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a word, found %2</source>
        <translation>“%1”必须是一个词，实际为%2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a map, found %2</source>
        <translation>“%1”必须是映射，实际为%2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a list of numbers, found %2</source>
        <translation>“%1”必须是数字列表，实际为%2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold numbers, found %2</source>
        <translation>“%1”只能包含数字，实际为 %2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold %2 numbers, found %3</source>
        <translation>“%1”必须包含 %2 个数字，实际有 %3 个</translation>
    </message>
    <message>
        <source>%1: unknown key &apos;%2&apos; ignored; did you mean &apos;%3&apos;?</source>
        <translation>%1：忽略未知的键“%2”；您是指“%3”吗？</translation>
    </message>
    <message>
        <source>%1: unknown key &apos;%2&apos; ignored</source>
        <translation>%1：忽略未知的键“%2”</translation>
    </message>
    <message>
        <source>not valid YAML: %1</source>
        <translation>不是有效的 YAML：%1</translation>
    </message>
    <message>
        <source>expected a YAML map of keys and values, found %1</source>
        <translation>应为由键和值组成的 YAML 映射，实际为%1</translation>
    </message>
    <message>
        <source>a number</source>
        <translation>数字</translation>
    </message>
    <message>
        <source>a word</source>
        <translation>一个词</translation>
    </message>
    <message>
        <source>a map</source>
        <translation>映射</translation>
    </message>
    <message>
        <source>a list of numbers</source>
        <translation>数字列表</translation>
    </message>
    <message>
        <source>a list of %1</source>
        <translation>%1 项的列表</translation>
    </message>
    <message>
        <source>a 3 × 3 matrix</source>
        <translation>3 × 3 矩阵</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>无</translation>
    </message>
    <message>
        <source>target_type &apos;%1&apos; is not known; expected aprilgrid_circles, aprilgrid, checkerboard, charuco or apriltag</source>
        <translation>未知的 target_type“%1”；应为 aprilgrid_circles、aprilgrid、checkerboard、charuco 或 apriltag</translation>
    </message>
    <message>
        <source>a checkerboard needs at least 3 × 3 inner corners</source>
        <translation>棋盘格至少需要 3 × 3 个内角点</translation>
    </message>
    <message>
        <source>square sizes must be positive</source>
        <translation>方格尺寸必须为正</translation>
    </message>
    <message>
        <source>the board outline is smaller than its pattern</source>
        <translation>标定板的外形小于其图案</translation>
    </message>
    <message>
        <source>measure boardWidth and boardHeight</source>
        <translation>请测量 boardWidth 和 boardHeight</translation>
    </message>
    <message>
        <source>marker ids %1 to %2 do not exist in %3, which has %4</source>
        <translation>%3 中没有编号 %1 到 %2 的标记，它共有 %4 个</translation>
    </message>
    <message>
        <source>tag ids %1 to %2 do not exist in %3, which has %4</source>
        <translation>%3 中没有编号 %1 到 %2 的标签，它共有 %4 个</translation>
    </message>
    <message>
        <source>the board is larger than 100 m</source>
        <translation>标定板大于 100 m</translation>
    </message>
    <message>
        <source>spacings and outline are in metres</source>
        <translation>间距和外形以米为单位</translation>
    </message>
    <message>
        <source>the pattern reaches beyond the board&apos;s outline</source>
        <translation>图案超出了标定板的外形</translation>
    </message>
    <message>
        <source>measure boardWidth, boardHeight and boardOffset</source>
        <translation>请测量 boardWidth、boardHeight 和 boardOffset</translation>
    </message>
    <message>
        <source>dictionary &apos;%1&apos; is not known; expected one of OpenCV&apos;s, DICT_4X4_50 to DICT_APRILTAG_36h11</source>
        <translation>未知的字典“%1”；应为 OpenCV 的字典之一：DICT_4X4_50 到 DICT_APRILTAG_36h11</translation>
    </message>
    <message>
        <source>did you mean %1?</source>
        <translation>您是指 %1 吗？</translation>
    </message>
    <message>
        <source>a ChArUco board needs at least 3 × 3 squares</source>
        <translation>ChArUco 板至少需要 3 × 3 个方格</translation>
    </message>
    <message>
        <source>squareSize must be positive and markerSize smaller than it</source>
        <translation>squareSize 必须为正，且 markerSize 小于它</translation>
    </message>
    <message>
        <source>tag family &apos;%1&apos; is not known; expected tag36h11, tag36h10, tag25h9 or tag16h5</source>
        <translation>未知的标签族“%1”；应为 tag36h11、tag36h10、tag25h9 或 tag16h5</translation>
    </message>
    <message>
        <source>tagSize must be positive</source>
        <translation>tagSize 必须为正</translation>
    </message>
    <message>
        <source>tagBorder must be 1 or 2</source>
        <translation>tagBorder 必须为 1 或 2</translation>
    </message>
    <message>
        <source>tagCols and tagRows must be at least 1</source>
        <translation>tagCols 和 tagRows 至少为 1</translation>
    </message>
    <message>
        <source>tagSize and tagSpacing must be positive, margin not negative</source>
        <translation>tagSize 和 tagSpacing 必须为正，margin 不得为负</translation>
    </message>
    <message>
        <source>circles need at least 2 × 2 tags</source>
        <translation>要有圆，至少需要 2 × 2 个标签</translation>
    </message>
    <message>
        <source>circleRadius must be positive and below %1 m, or circles run into the tags</source>
        <translation>circleRadius 必须为正且小于 %1 m，否则圆会碰到标签</translation>
    </message>
    <message>
        <source>measuredLength and drawnLength belong together, both in metres, and no print is off by more than a tenth; found %1 and %2</source>
        <translation>measuredLength 与 drawnLength 须同时给出，均以米为单位，且任何打印的误差都不会超过十分之一；实际为 %1 和 %2</translation>
    </message>
    <message>
        <source>the intrinsics must be finite numbers</source>
        <translation>内参必须是有限的数</translation>
    </message>
    <message>
        <source>a focal length of %1 px is not plausible for an image %2 px long</source>
        <translation>对于长 %2 px 的图像，焦距 %1 px 不合理</translation>
    </message>
    <message>
        <source>focal lengths are given in pixels</source>
        <translation>焦距以像素为单位</translation>
    </message>
    <message>
        <source>%1: the distortion folds back inside the image: %2 of its 4 corners have no ray; are the coefficients right?</source>
        <translation>%1：畸变在图像内部折返：4 个角中有 %2 个没有对应的射线；系数正确吗？</translation>
    </message>
    <message>
        <source>standard deviations must be 0 or more</source>
        <translation>标准差必须大于等于 0</translation>
    </message>
    <message>
        <source>&apos;distortion&apos; holds %1 standard deviations, but the model has %2 coefficients</source>
        <translation>“distortion”包含 %1 个标准差，但模型有 %2 个系数</translation>
    </message>
    <message>
        <source>is no folder</source>
        <translation>不是文件夹</translation>
    </message>
    <message>
        <source>give the folder that holds the files</source>
        <translation>请给出文件所在的文件夹</translation>
    </message>
    <message>
        <source>give the folder that holds them</source>
        <translation>请给出它们所在的文件夹</translation>
    </message>
    <message>
        <source>holds no images; expected png, jpg, bmp or tiff files</source>
        <translation>不含图像；应有 .png、.jpg、.bmp 或 .tiff 文件</translation>
    </message>
    <message>
        <source>holds no clouds; expected pcd, ply or KITTI&apos;s bin files</source>
        <translation>不含点云；应有 .pcd、.ply 或 KITTI 的 .bin 文件</translation>
    </message>
    <message>
        <source>the names of its files are no times: %1</source>
        <translation>其文件名不是时间：%1</translation>
    </message>
    <message>
        <source>expected seconds, ms, µs or ns: 1650000000.25.png</source>
        <translation>应为秒、ms、µs 或 ns：1650000000.25.png</translation>
    </message>
    <message>
        <source>no image and cloud belong together: found %1 and %2</source>
        <translation>没有图像与点云相配：找到 %1 和 %2</translation>
    </message>
    <message>
        <source>give both the same name, the same number, or their times as names</source>
        <translation>请给两者相同的名称、相同的编号，或以时间为名</translation>
    </message>
    <message>
        <source>%1 more files without a partner</source>
        <translation>另有 %1 个文件没有配对</translation>
    </message>
    <message>
        <source>no intrinsics lie with the files; put a camera.yaml into the dataset before it is calibrated</source>
        <translation>文件旁没有内参；标定之前请在数据集中放入 camera.yaml</translation>
    </message>
    <message>
        <source>none of its %1 pairs can be used; %2: %3</source>
        <translation>其 %1 对文件均不可用；%2：%3</translation>
    </message>
    <message>
        <source>none of its clouds can be read</source>
        <translation>其点云均无法读取</translation>
    </message>
    <message>
        <source>holds no clouds</source>
        <translation>不含点云</translation>
    </message>
    <message>
        <source>holds %1 bytes; expected 16 for each point: x, y, z and reflectance as 4-byte floats</source>
        <translation>包含 %1 字节；每个点应为 16 字节：x、y、z 和反射率，均为 4 字节浮点数</translation>
    </message>
    <message>
        <source>no image was taken in this time</source>
        <translation>这段时间内没有拍摄图像</translation>
    </message>
    <message>
        <source>its edges were set by hand: %1 s</source>
        <translation>边缘由手动设定：%1 s</translation>
    </message>
    <message>
        <source>the stretch moved to %1 s to %2 s overlaps that from %3 s to %4 s</source>
        <translation>移动到 %1 s 至 %2 s 的时段与 %3 s 至 %4 s 的时段重叠</translation>
    </message>
    <message>
        <source>move its edges so that both stay apart</source>
        <translation>请移动其边缘，使两者分开</translation>
    </message>
    <message>
        <source>off the board&apos;s plane</source>
        <translation>偏离标定板平面</translation>
    </message>
    <message>
        <source>something stands before the board there or lies on it</source>
        <translation>该处有东西挡在标定板前或贴在标定板上</translation>
    </message>
    <message>
        <source>predicting measurements</source>
        <translation>正在预测测量</translation>
    </message>
    <message>
        <source>choosing scene %1</source>
        <translation>正在选择场景 %1</translation>
    </message>
    <message>
        <source>the grid has no more poses than %1</source>
        <translation>网格中只有 %1 个位姿</translation>
    </message>
    <message>
        <source>so few scenes do not determine the extrinsic</source>
        <translation>场景太少，无法确定外参</translation>
    </message>
    <message>
        <source>%1 stays hard to test: at its size of interest it stands %2 σ above zero; to see it: %3</source>
        <translation>%1仍难以检验：取关注大小时只比零高 %2 σ；要看到它：%3</translation>
    </message>
    <message>
        <source>no board pose of the grid is in view of both sensors (%1 are in view of the camera)</source>
        <translation>网格中没有两个传感器都能看到的标定板位姿（相机能看到 %1 个）</translation>
    </message>
    <message>
        <source>check the field of view and T_camera_lidar, or use a smaller board</source>
        <translation>请检查视场和 T_camera_lidar，或使用更小的标定板</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; cannot be planned for: %2</source>
        <translation>无法为效应“%1”规划：%2</translation>
    </message>
    <message>
        <source>the LiDAR&apos;s description says no time</source>
        <translation>激光雷达描述中没有时间</translation>
    </message>
    <message>
        <source>the LiDAR&apos;s description has one line only</source>
        <translation>激光雷达描述中只有一条线</translation>
    </message>
    <message>
        <source>the LiDAR&apos;s description says no intensity</source>
        <translation>激光雷达描述中没有强度</translation>
    </message>
    <message>
        <source>this board has no tags</source>
        <translation>此标定板没有标签</translation>
    </message>
    <message>
        <source>planning: what is known of the extrinsic before must be a covariance without directions that are known exactly or not at all</source>
        <translation>规划：事先已知的外参信息必须是协方差，且没有完全已知或完全未知的方向</translation>
    </message>
    <message>
        <source>%1: expected %2, found &apos;%3&apos;</source>
        <translation>%1：应为 %2，实为“%3”</translation>
    </message>
    <message>
        <source>%1: expected [low, high] in %2 to %3 degrees</source>
        <translation>%1：应为 [下限, 上限]，在 %2 到 %3 度之间</translation>
    </message>
    <message>
        <source>%1: its left 3x3 part is not a rotation</source>
        <translation>%1：其左侧 3x3 部分不是旋转矩阵</translation>
    </message>
    <message>
        <source>is still being written</source>
        <translation>仍在写入</translation>
    </message>
    <message>
        <source>cannot be read yet: %1</source>
        <translation>尚无法读取：%1</translation>
    </message>
    <message>
        <source>no cloud belongs to it</source>
        <translation>没有对应的点云</translation>
    </message>
    <message>
        <source>no image belongs to it</source>
        <translation>没有对应的图像</translation>
    </message>
    <message>
        <source>no image in this scene; expected image.png, .jpg, .bmp or .tiff</source>
        <translation>此场景没有图像；应有 image.png、.jpg、.bmp 或 .tiff</translation>
    </message>
    <message>
        <source>no cloud in this scene; expected cloud.pcd or cloud.ply</source>
        <translation>此场景没有点云；应有 cloud.pcd 或 cloud.ply</translation>
    </message>
    <message>
        <source>there is already a scene of this name</source>
        <translation>已有同名场景</translation>
    </message>
    <message>
        <source>folder not found</source>
        <translation>找不到文件夹</translation>
    </message>
    <message>
        <source>cannot be listed: %1</source>
        <translation>无法列出：%1</translation>
    </message>
    <message>
        <source>take an image of this camera, not cropped or scaled</source>
        <translation>请使用此相机的图像，不要裁剪或缩放</translation>
    </message>
    <message>
        <source>the cloud shows no edge</source>
        <translation>点云中没有边缘</translation>
    </message>
    <message>
        <source>take a place with things before others</source>
        <translation>请选有前后遮挡物体的地方</translation>
    </message>
    <message>
        <source>the image shows no edge</source>
        <translation>图像中没有边缘</translation>
    </message>
    <message>
        <source>see whether it is black or blurred</source>
        <translation>请检查图像是否全黑或模糊</translation>
    </message>
    <message>
        <source>no scene has an image and a cloud</source>
        <translation>没有同时有图像和点云的场景</translation>
    </message>
    <message>
        <source>there is no image with a cloud to check</source>
        <translation>没有可检验的图像和点云</translation>
    </message>
    <message>
        <source>left out: %1</source>
        <translation>跳过：%1</translation>
    </message>
    <message>
        <source>reading %1</source>
        <translation>正在读取 %1</translation>
    </message>
    <message>
        <source>comparing edges</source>
        <translation>正在比较边缘</translation>
    </message>
    <message>
        <source>calib.txt of KITTI&apos;s benchmarks, for undistorted images</source>
        <translation>KITTI 基准的 calib.txt，用于去畸变图像</translation>
    </message>
    <message>
        <source>text model of COLMAP: the scenes&apos; images with their poses, the LiDAR&apos;s beside</source>
        <translation>COLMAP 文本模型：各场景图像及其位姿，并附激光雷达位姿</translation>
    </message>
    <message>
        <source>the cloud of a scene with the image&apos;s colours (binary PLY)</source>
        <translation>一个场景的点云，带图像颜色（二进制 PLY）</translation>
    </message>
    <message>
        <source>the result names no image of a scene in use</source>
        <translation>结果中没有所用场景的图像</translation>
    </message>
    <message>
        <source>the result names no image and cloud of a scene in use</source>
        <translation>结果中没有所用场景的图像和点云</translation>
    </message>
    <message>
        <source>calibrate again with this version</source>
        <translation>请用此版本重新标定</translation>
    </message>
    <message>
        <source>is of another size than the camera&apos;s images</source>
        <translation>与相机图像的尺寸不同</translation>
    </message>
    <message>
        <source>white print is saturated, so that the place of its edges is not measured: scene %1; lower the LiDAR&apos;s gain or print the white greyer</source>
        <translation>白色印刷部分已饱和，无法测量其边缘的位置：场景 %1；请降低激光雷达增益，或将白色印得灰一些</translation>
    </message>
    <message>
        <source>the board is not found in the cloud, which holds %1 points only</source>
        <translation>点云中未找到标定板：该点云只有 %1 个点</translation>
    </message>
    <message>
        <source>the clouds hold a second board with this print: another extrinsic has %1 % of the evidence of this one; take one of the boards away, or give a rough extrinsic with --init</source>
        <translation>点云中有第二块同样图案的标定板：另一外参拥有此外参 %1 % 的证据；请移走其中一块，或用 --init 给出粗略外参</translation>
    </message>
    <message>
        <source>the board moves against the LiDAR while it scans, in all scenes alike, by %1 mm/s; with that the extrinsic moves by %2 mm and %3 mrad; let board and rig rest, or find the effect with lvcalib discover</source>
        <translation>扫描期间标定板相对激光雷达运动，所有场景一致，速度 %1 mm/s；计入后外参移动 %2 mm 和 %3 mrad；请让标定板和设备静止，或用 lvcalib discover 查找该效应</translation>
    </message>
    <message>
        <source>the board moves against the LiDAR while it scans, in scene %1, by %2 mm/s; with that the extrinsic moves by %3 mm and %4 mrad; let board and rig rest, or find the effect with lvcalib discover</source>
        <translation>扫描期间场景 %1 中标定板相对激光雷达运动，速度 %2 mm/s；计入后外参移动 %3 mm 和 %4 mrad；请让标定板和设备静止，或用 lvcalib discover 查找该效应</translation>
    </message>
    <message>
        <source>the print lies displaced along the scan, by %1 µs of it; with that the extrinsic moves by %2 mm and %3 mrad: intensity or angle is read too late; find the effect with lvcalib discover</source>
        <translation>图案沿扫描方向偏移，相当于 %1 µs 的扫描；计入后外参移动 %2 mm 和 %3 mrad：强度或角度读取滞后；请用 lvcalib discover 查找该效应</translation>
    </message>
    <message>
        <source>the LiDAR&apos;s angles do not fit the boards (scale, eccentric encoder or tilted axis); with that the extrinsic moves by %1 mm and %2 mrad: find the effect with lvcalib discover</source>
        <translation>激光雷达的角度与标定板不符（比例、编码器偏心或轴倾斜）；计入后外参移动 %1 mm 和 %2 mrad：请用 lvcalib discover 查找该效应</translation>
    </message>
    <message>
        <source>the clouds&apos; coordinates are rounded to steps of %1 mm, which may displace edges of the print by %2 mm: scene %3; write them to the millimetre</source>
        <translation>点云坐标被取整为 %1 mm 的步长，可能使图案边缘偏移 %2 mm：场景 %3；请以毫米或更细的精度写出</translation>
    </message>
    <message>
        <source>scene %1 contradicts the others, which agree: it puts the LiDAR %2 mm and %3 mrad elsewhere; did the board or a sensor move while it was taken?</source>
        <translation>场景 %1 与其余彼此一致的场景矛盾：它把激光雷达放在相差 %2 mm 和 %3 mrad 的位置；采集它时标定板或传感器是否移动过？</translation>
    </message>
    <message>
        <source>the extrinsic moves steadily from scene to scene, by %1 mm and %2 mrad from the first to the last: does a mount give way?</source>
        <translation>外参随场景持续移动，从第一个场景到最后一个场景共 %1 mm 和 %2 mrad：是否有支架松动？</translation>
    </message>
    <message>
        <source>the clouds or the images of scenes %1 and %2 seem to be exchanged: all scenes agree if they are</source>
        <translation>场景 %1 与 %2 的点云或图像似乎互换了：换回来后所有场景一致</translation>
    </message>
    <message>
        <source> These scenes cannot tell it from %1; to tell: %2.</source>
        <translation>这些场景无法将它与 %1 区分；要区分需要：%2。</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>%1 (it could move the extrinsic by %2 mm and %3 mrad)</source>
        <translation>%1（它可能使外参移动 %2 mm 和 %3 mrad）</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 和 %2</translation>
    </message>
    <message>
        <source>%1 and whose tags are each turned by %2°</source>
        <translation>%1，且每个标签各旋转 %2°</translation>
    </message>
    <message>
        <source>%1 has %2 different labels, expected at most %3</source>
        <translation>%1 有 %2 个不同的类别，至多应为 %3 个</translation>
    </message>
    <message>
        <source>%1 is not a finite number on some rows</source>
        <translation>%1 在某些行上不是有限的数</translation>
    </message>
    <message>
        <source>%1 is the same on all rows</source>
        <translation>%1 在所有行上都相同</translation>
    </message>
    <message>
        <source>%1 scenes</source>
        <translation>%1 个场景</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
    <message>
        <source>%1 topics hold clouds: %2</source>
        <translation>有 %1 个话题含有点云：%2</translation>
    </message>
    <message>
        <source>%1 topics hold images: %2</source>
        <translation>有 %1 个话题含有图像：%2</translation>
    </message>
    <message>
        <source>%1 usable scenes; a target without circles needs three or more, differently turned</source>
        <translation>可用场景 %1 个；没有圆的标定板需要三个或更多朝向不同的场景</translation>
    </message>
    <message>
        <source>%1 would fit (corners then scatter by %2 px, now by %3 px)</source>
        <translation>%1 则相符（角点离散将为 %2 px，现为 %3 px）</translation>
    </message>
    <message>
        <source>%1%2</source>
        <translation>%1%2</translation>
    </message>
    <message>
        <source>%1, or upside down and whose tags are each turned by 180°</source>
        <translation>%1，或上下颠倒且每个标签各旋转 180°</translation>
    </message>
    <message>
        <source>%1-bit border</source>
        <translation>%1 位宽黑边</translation>
    </message>
    <message>
        <source>%1.id is &apos;%2&apos;, which is no effect that this version knows</source>
        <translation>%1.id 为“%2”，此版本不认识这个效应</translation>
    </message>
    <message>
        <source>%1.id is &apos;%2&apos;, which is no effect that this version knows; did you mean &apos;%3&apos;?</source>
        <translation>%1.id 为“%2”，此版本不认识这个效应；您是指“%3”吗？</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>%1: %2; left out</source>
        <translation>%1：%2；已略去</translation>
    </message>
    <message>
        <source>%1: 4 distortion coefficients and no distortion_model: taken as k1 k2 p1 p2; add &apos;distortion_model: equidistant&apos; if this is a fisheye lens</source>
        <translation>%1：有 4 个畸变系数而没有 distortion_model：按 k1 k2 p1 p2 处理；若为鱼眼镜头，请添加“distortion_model: equidistant”</translation>
    </message>
    <message>
        <source>%1: a chunk is packed as &apos;%2&apos;, which is not known; expected none, bz2 or lz4</source>
        <translation>%1：某个数据块的压缩方式为“%2”，无法识别；应为 none、bz2 或 lz4</translation>
    </message>
    <message>
        <source>%1: cannot be read, and stays as it is</source>
        <translation>%1：无法读取，保持原样</translation>
    </message>
    <message>
        <source>%1: expected 3 or 4 rows of 4 numbers, found %2 numbers</source>
        <translation>%1：应为 3 或 4 行、每行 4 个数，实际有 %2 个数</translation>
    </message>
    <message>
        <source>%1: expected true or false, found &apos;%2&apos;</source>
        <translation>%1：应为 true 或 false，实际为“%2”</translation>
    </message>
    <message>
        <source>%1: holds %2 cameras; &apos;%3&apos; is used</source>
        <translation>%1：含有 %2 个相机；使用“%3”</translation>
    </message>
    <message>
        <source>%1: is of images of %2 × %3 px, but they have %4 × %5</source>
        <translation>%1：对应 %2 × %3 px 的图像，而实际图像为 %4 × %5</translation>
    </message>
    <message>
        <source>%1: the chunk at byte %2 is damaged</source>
        <translation>%1：第 %2 字节处的数据块已损坏</translation>
    </message>
    <message>
        <source>%1: the chunk at byte %2 is packed as &apos;%3&apos;, which is not known; expected lz4 or zstd</source>
        <translation>%1：第 %2 字节处的数据块压缩方式为“%3”，无法识别；应为 lz4 或 zstd</translation>
    </message>
    <message>
        <source>%1:%2: %3</source>
        <translation>%1:%2：%3</translation>
    </message>
    <message>
        <source>%1; it is left out</source>
        <translation>%1；已将其略去</translation>
    </message>
    <message>
        <source>%1; left out</source>
        <translation>%1；已略去</translation>
    </message>
    <message>
        <source>%1° above</source>
        <translation>上方 %1°</translation>
    </message>
    <message>
        <source>%1° below</source>
        <translation>下方 %1°</translation>
    </message>
    <message>
        <source>%1° left</source>
        <translation>左侧 %1°</translation>
    </message>
    <message>
        <source>%1° right</source>
        <translation>右侧 %1°</translation>
    </message>
    <message>
        <source>&apos;%1&apos;</source>
        <translation>“%1”</translation>
    </message>
    <message>
        <source>&apos;%1&apos; holds %2 numbers, but this distortion model has %3; thin-prism and tilt terms are not supported</source>
        <translation>“%1”包含 %2 个数，但此畸变模型有 %3 个；不支持薄棱镜项和倾斜项</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be [fx, 0, cx, 0, fy, cy, 0, 0, 1] row by row%2</source>
        <translation>“%1”必须逐行为 [fx, 0, cx, 0, fy, cy, 0, 0, 1]%2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a list of folders</source>
        <translation>“%1”必须是文件夹列表</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a list of scenes</source>
        <translation>“%1”必须是场景列表</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a matrix, or have translation_m and quaternion_xyzw</source>
        <translation>“%1”必须是矩阵，或包含 translation_m 和 quaternion_xyzw</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be a number</source>
        <translation>“%1”必须是数字</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must be true or false</source>
        <translation>“%1”必须为 true 或 false</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold %2 numbers for each place</source>
        <translation>“%1”中每个位置必须有 %2 个数</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold %2 numbers for this distortion model, found %3</source>
        <translation>对于此畸变模型，“%1”必须包含 %2 个数，实际有 %3 个</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold 12 or 16 numbers, found %2</source>
        <translation>“%1”必须包含 12 或 16 个数，实际有 %2 个</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold 9 numbers, found %2</source>
        <translation>“%1”必须包含 9 个数，实际有 %2 个</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold ids</source>
        <translation>“%1”只能包含编号</translation>
    </message>
    <message>
        <source>&apos;%1&apos; must hold width and height in whole pixels</source>
        <translation>“%1”必须包含宽度和高度，以整像素为单位</translation>
    </message>
    <message>
        <source>&apos;%1&apos; says %2 × %3 but holds %4 numbers</source>
        <translation>“%1”标明为 %2 × %3，但包含 %4 个数</translation>
    </message>
    <message>
        <source>&apos;dataset&apos; is empty</source>
        <translation>“dataset”为空</translation>
    </message>
    <message>
        <source>&apos;model&apos; must be a list of changes</source>
        <translation>“model”必须是更改的列表</translation>
    </message>
    <message>
        <source>&apos;options&apos; must hold &apos;name: value&apos; entries</source>
        <translation>“options”必须由“名称: 值”条目组成</translation>
    </message>
    <message>
        <source>&apos;patches_m&apos; must be a list of polygons</source>
        <translation>“patches_m”必须是多边形列表</translation>
    </message>
    <message>
        <source>, %1 and %2 of the optical axis</source>
        <translation>，在光轴%1、%2 处</translation>
    </message>
    <message>
        <source>, %1 of the optical axis</source>
        <translation>，在光轴%1 处</translation>
    </message>
    <message>
        <source>, facing the camera</source>
        <translation>，正对相机</translation>
    </message>
    <message>
        <source>, first where %1</source>
        <translation>，首次出现于 %1</translation>
    </message>
    <message>
        <source>, in the middle of the image</source>
        <translation>，在图像正中</translation>
    </message>
    <message>
        <source>, or as a closed form: --with &apos;%1&apos;</source>
        <translation>，或以闭式公式去除：--with “%1”</translation>
    </message>
    <message>
        <source>, rolled by %1°</source>
        <translation>，面内旋转 %1°</translation>
    </message>
    <message>
        <source>, the left side turned away by %1°</source>
        <translation>，左边后转 %1°</translation>
    </message>
    <message>
        <source>, the right side turned away by %1°</source>
        <translation>，右边后转 %1°</translation>
    </message>
    <message>
        <source>, the top leaning away by %1°</source>
        <translation>，上边后仰 %1°</translation>
    </message>
    <message>
        <source>, the top leaning towards the camera by %1°</source>
        <translation>，上边向相机前倾 %1°</translation>
    </message>
    <message>
        <source>1 scene</source>
        <translation>1 个场景</translation>
    </message>
    <message>
        <source>4 or 5</source>
        <translation>4 或 5</translation>
    </message>
    <message>
        <source>; did you mean &apos;%1&apos;?</source>
        <translation>；您是指“%1”吗？</translation>
    </message>
    <message>
        <source>; skew is not supported</source>
        <translation>；不支持倾斜（轴不垂直）参数</translation>
    </message>
    <message>
        <source>; there is %1</source>
        <translation>；可用的有 %1</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR sees it about %1 % larger than target.yaml says</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达测得比 target.yaml 约大 %1 %</translation>
    </message>
    <message>
        <source>LiDAR and camera disagree on the board&apos;s size: the LiDAR sees it about %1 % smaller than target.yaml says</source>
        <translation>激光雷达与相机对标定板尺寸的判断不一致：激光雷达测得比 target.yaml 约小 %1 %</translation>
    </message>
    <message>
        <source>No further scene of this board will show %1; measure instead: %2</source>
        <translation>用此标定板再拍摄任何场景都看不到 %1；请改为测量：%2</translation>
    </message>
    <message>
        <source>No further scene of this board will tell %1 from %2 (at best %3 σ); measure instead: %4</source>
        <translation>用此标定板再拍摄任何场景都无法区分 %1 与 %2（至多 %3 σ）；请改为测量：%4</translation>
    </message>
    <message>
        <source>T_CL is missing or not 3 rows of 4 numbers</source>
        <translation>缺少 T_CL，或它不是 3 行、每行 4 个数</translation>
    </message>
    <message>
        <source>T_camera_lidar.matrix is missing or not 4 rows of 4 numbers</source>
        <translation>缺少 T_camera_lidar.matrix，或它不是 4 行、每行 4 个数</translation>
    </message>
    <message>
        <source>The extrinsic&apos;s weakest direction gains most from a scene with the board %1: its standard deviation falls from %2 to %3 mm (or mrad)</source>
        <translation>对外参最弱的方向改善最大的场景是：标定板%1；其标准差由 %2 降至 %3 mm（或 mrad）</translation>
    </message>
    <message>
        <source>To see whether %1 is there (it could move the extrinsic by %2 mm and %3 mrad), take: %4</source>
        <translation>要看 %1 是否存在（它可能使外参移动 %2 mm 和 %3 mrad），请拍摄：%4</translation>
    </message>
    <message>
        <source>To see whether there is %1, take a scene with the board %2; at its size of interest it would stand %3 σ (now %4 σ)</source>
        <translation>要看是否存在 %1，请拍摄一个场景，标定板%2；取关注大小时将达 %3 σ（现为 %4 σ）</translation>
    </message>
    <message>
        <source>To tell %1 from %2, take a scene with the board %3; the difference would stand %4 σ (now %5 σ)</source>
        <translation>要区分 %1 与 %2，请拍摄一个场景，标定板%3；两者之差将达 %4 σ（现为 %5 σ）</translation>
    </message>
    <message>
        <source>To tell %1 from %2, take: %3</source>
        <translation>要区分 %1 与 %2，请拍摄：%3</translation>
    </message>
    <message>
        <source>XML intrinsics are not read</source>
        <translation>不读取 XML 格式的内参</translation>
    </message>
    <message>
        <source>YAML is nested too deeply or far too large</source>
        <translation>YAML 嵌套过深或过大</translation>
    </message>
    <message>
        <source>&quot;distortion_coeffs&quot; holds more numbers than its model has</source>
        <translation>“distortion_coeffs”包含的数多于其模型的系数</translation>
    </message>
    <message>
        <source>&quot;intrinsics&quot; must hold fx, fy, cx, cy</source>
        <translation>“intrinsics”必须包含 fx、fy、cx、cy</translation>
    </message>
    <message>
        <source>a board&apos;s pose needs four corners, found %1</source>
        <translation>求标定板位姿需要四个角点，实际有 %1 个</translation>
    </message>
    <message>
        <source>a change of the model needs &apos;change&apos; and &apos;effect&apos;</source>
        <translation>模型的更改需要“change”和“effect”</translation>
    </message>
    <message>
        <source>a cloud claims %1 × %2 points of %3 bytes and holds %4 bytes</source>
        <translation>点云标明有 %1 × %2 个点、每点 %3 字节，实际包含 %4 字节</translation>
    </message>
    <message>
        <source>a cloud is written of one scene</source>
        <translation>点云只能按单个场景写出</translation>
    </message>
    <message>
        <source>a compressed bmp file, which cannot be read</source>
        <translation>压缩的 bmp 文件，无法读取</translation>
    </message>
    <message>
        <source>a compressed image (format &apos;%1&apos;) is damaged: %2</source>
        <translation>压缩图像（格式“%1”）已损坏：%2</translation>
    </message>
    <message>
        <source>a compressed image (format &apos;%1&apos;) is neither jpeg nor png</source>
        <translation>压缩图像（格式“%1”）既不是 jpeg 也不是 png</translation>
    </message>
    <message>
        <source>a compressed image claims %1 × %2 pixels</source>
        <translation>压缩图像标明为 %1 × %2 像素</translation>
    </message>
    <message>
        <source>a file is in the way</source>
        <translation>该位置已有同名文件</translation>
    </message>
    <message>
        <source>a list of property &apos;%1&apos; has an impossible length</source>
        <translation>属性“%1”的某个列表长度不可能成立</translation>
    </message>
    <message>
        <source>a message is empty</source>
        <translation>有一条消息为空</translation>
    </message>
    <message>
        <source>a message is not CDR: it begins with %1 %2, expected 0 and 0 or 1</source>
        <translation>有一条消息不是 CDR：它以 %1 %2 开头，应为 0 和 0 或 1</translation>
    </message>
    <message>
        <source>a message of type %1 ends before its data do</source>
        <translation>一条类型为 %1 的消息在其数据结束之前中断</translation>
    </message>
    <message>
        <source>a number of the crop box is not finite</source>
        <translation>裁剪框中有一个数不是有限的数</translation>
    </message>
    <message>
        <source>ablation is not a list</source>
        <translation>ablation 不是列表</translation>
    </message>
    <message>
        <source>ablation[%1] must hold name, rms_px, rms_mm and T_camera_lidar (4 rows of 4 numbers)</source>
        <translation>ablation[%1] 必须包含 name、rms_px、rms_mm 和 T_camera_lidar（4 行、每行 4 个数）</translation>
    </message>
    <message>
        <source>all of it must be visible; check targetCols and targetRows</source>
        <translation>它必须全部可见；请检查 targetCols 和 targetRows</translation>
    </message>
    <message>
        <source>an image cannot be decoded: its data are damaged</source>
        <translation>有一幅图像无法解码：数据已损坏</translation>
    </message>
    <message>
        <source>an image claims %1 × %2 pixels (%3, step %4) and holds %5 bytes</source>
        <translation>图像标明为 %1 × %2 像素（%3，step %4），实际包含 %5 字节</translation>
    </message>
    <message>
        <source>and more</source>
        <translation>以及其他场景</translation>
    </message>
    <message>
        <source>at %1 m</source>
        <translation>位于 %1 m 处</translation>
    </message>
    <message>
        <source>bottom</source>
        <translation>下方</translation>
    </message>
    <message>
        <source>bottom left</source>
        <translation>左下</translation>
    </message>
    <message>
        <source>bottom right</source>
        <translation>右下</translation>
    </message>
    <message>
        <source>bundle adjustment</source>
        <translation>光束法平差</translation>
    </message>
    <message>
        <source>calibrate again (%1 is of the file as it was before)</source>
        <translation>请重新标定（%1 对应的是更改之前的文件）</translation>
    </message>
    <message>
        <source>calibrate again with this version, which stores the intrinsics</source>
        <translation>请用此版本重新标定，它会保存内参</translation>
    </message>
    <message>
        <source>calibrate the camera again, or use --intrinsics free</source>
        <translation>请重新标定相机，或使用 --intrinsics free</translation>
    </message>
    <message>
        <source>camera.%1 is missing or not a number</source>
        <translation>缺少 camera.%1，或它不是数字</translation>
    </message>
    <message>
        <source>camera.distortion holds something that is no number</source>
        <translation>camera.distortion 含有不是数字的内容</translation>
    </message>
    <message>
        <source>camera.distortion is missing or of another length than its model&apos;s</source>
        <translation>缺少 camera.distortion，或其长度与其模型不符</translation>
    </message>
    <message>
        <source>camera.distortion_model is none of plumb_bob, rational_polynomial, equidistant</source>
        <translation>camera.distortion_model 不是 plumb_bob、rational_polynomial、equidistant 之一</translation>
    </message>
    <message>
        <source>camera.width and camera.height are no image size</source>
        <translation>camera.width 和 camera.height 不是有效的图像尺寸</translation>
    </message>
    <message>
        <source>camera_model &apos;%1&apos; is not supported; expected pinhole</source>
        <translation>不支持 camera_model“%1”；应为 pinhole</translation>
    </message>
    <message>
        <source>cannot be made: %1</source>
        <translation>无法创建：%1</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>无法打开</translation>
    </message>
    <message>
        <source>cannot be put in place: %1</source>
        <translation>无法放置到目标位置：%1</translation>
    </message>
    <message>
        <source>cannot be read to its end</source>
        <translation>无法读取到末尾</translation>
    </message>
    <message>
        <source>cannot be read: %1</source>
        <translation>无法读取：%1</translation>
    </message>
    <message>
        <source>cannot be written</source>
        <translation>无法写入</translation>
    </message>
    <message>
        <source>cannot be written: %1</source>
        <translation>无法写入：%1</translation>
    </message>
    <message>
        <source>check firstMarkerId, targetCols and targetRows, or use the right board</source>
        <translation>请检查 firstMarkerId、targetCols 和 targetRows，或使用正确的标定板</translation>
    </message>
    <message>
        <source>check firstTagId, tagCols and tagRows, or use the right board</source>
        <translation>请检查 firstTagId、tagCols 和 tagRows，或使用正确的标定板</translation>
    </message>
    <message>
        <source>check tagCols, tagRows, tagSpacing and the intrinsics</source>
        <translation>请检查 tagCols、tagRows、tagSpacing 和内参</translation>
    </message>
    <message>
        <source>check tagId, or use the right board</source>
        <translation>请检查 tagId，或使用正确的标定板</translation>
    </message>
    <message>
        <source>check target.yaml, and take more images of the board, turned by 20° to 45°</source>
        <translation>请检查 target.yaml，并多拍摄一些标定板转动 20° 至 45° 的图像</translation>
    </message>
    <message>
        <source>check targetCols, targetRows, firstMarkerId, legacyPattern and the intrinsics</source>
        <translation>请检查 targetCols、targetRows、firstMarkerId、legacyPattern 和内参</translation>
    </message>
    <message>
        <source>check that target.yaml describes this board</source>
        <translation>请检查 target.yaml 描述的是否为此标定板</translation>
    </message>
    <message>
        <source>check that the LiDAR sees the whole board and that target.yaml describes it</source>
        <translation>请检查激光雷达是否看到整块标定板，以及 target.yaml 描述的是否为它</translation>
    </message>
    <message>
        <source>check the driver or the export that wrote the file</source>
        <translation>请检查写出此文件的驱动或导出程序</translation>
    </message>
    <message>
        <source>check the intrinsics and the target&apos;s description</source>
        <translation>请检查内参和标定板的描述</translation>
    </message>
    <message>
        <source>choose a larger paper; is the board&apos;s size in metres?</source>
        <translation>请选择更大的纸张；标定板的尺寸是否以米为单位？</translation>
    </message>
    <message>
        <source>choose one with %1</source>
        <translation>请用 %1 选择一个</translation>
    </message>
    <message>
        <source>cloud has columns of different length</source>
        <translation>点云各列的长度不同</translation>
    </message>
    <message>
        <source>convert it to PCD with x y z intensity</source>
        <translation>请将其转换为含 x y z intensity 的 PCD</translation>
    </message>
    <message>
        <source>copy or export the file again</source>
        <translation>请重新复制或导出该文件</translation>
    </message>
    <message>
        <source>copy or save the image again</source>
        <translation>请重新复制或保存该图像</translation>
    </message>
    <message>
        <source>corners miss the board by %1 px RMS: check the intrinsics and the target&apos;s measures</source>
        <translation>角点偏离标定板 %1 px（均方根）：请检查内参和标定板的尺寸</translation>
    </message>
    <message>
        <source>corners miss the camera by %1 px where their noise is %2 px: the board is not flat, or the lens is not of this distortion model</source>
        <translation>角点偏离相机模型 %1 px，而其噪声为 %2 px：标定板不平整，或镜头不符合此畸变模型</translation>
    </message>
    <message>
        <source>correct target.yaml, or use the right board</source>
        <translation>请更正 target.yaml，或使用正确的标定板</translation>
    </message>
    <message>
        <source>corrected bits must be 0, 1 or 2</source>
        <translation>纠正的位数必须为 0、1 或 2</translation>
    </message>
    <message>
        <source>counting messages</source>
        <translation>正在统计消息</translation>
    </message>
    <message>
        <source>cover one of them, or leave this scene out</source>
        <translation>请遮住其中一块，或弃用该场景</translation>
    </message>
    <message>
        <source>dataset folder not found; expected target.yaml, camera.yaml and scenes/ in it</source>
        <translation>找不到数据集文件夹；其中应有 target.yaml、camera.yaml 和 scenes/</translation>
    </message>
    <message>
        <source>describe the board with target_type: aprilgrid or apriltag</source>
        <translation>请用 target_type: aprilgrid 或 apriltag 描述标定板</translation>
    </message>
    <message>
        <source>describe the board with target_type: charuco</source>
        <translation>请用 target_type: charuco 描述标定板</translation>
    </message>
    <message>
        <source>distortion model &apos;%1&apos; has %2 coefficients, found %3</source>
        <translation>畸变模型“%1”有 %2 个系数，实际为 %3 个</translation>
    </message>
    <message>
        <source>distortion model &apos;%1&apos; is not known; expected plumb_bob, rational_polynomial or equidistant%2</source>
        <translation>未知的畸变模型“%1”；应为 plumb_bob、rational_polynomial 或 equidistant%2</translation>
    </message>
    <message>
        <source>distortion model &apos;%1&apos; is not known; read are plumb_bob, rational_polynomial and equidistant</source>
        <translation>未知的畸变模型“%1”；可读取的是 plumb_bob、rational_polynomial 和 equidistant</translation>
    </message>
    <message>
        <source>divisions by zero, roots and logarithms of negative numbers do that</source>
        <translation>除以零、负数开方或取对数会导致这种情况</translation>
    </message>
    <message>
        <source>does not fit into memory</source>
        <translation>内存中放不下</translation>
    </message>
    <message>
        <source>drawing</source>
        <translation>正在绘制</translation>
    </message>
    <message>
        <source>edges agree better after a turn by %1 mrad and a shift by %2 mm: they are %3 px off</source>
        <translation>旋转 %1 mrad 并平移 %2 mm 后边缘更吻合：目前相差 %3 px</translation>
    </message>
    <message>
        <source>edges agree to %1 ± %2 px</source>
        <translation>边缘吻合，相差 %1 ± %2 px</translation>
    </message>
    <message>
        <source>encoding</source>
        <translation>正在编码</translation>
    </message>
    <message>
        <source>estimating surfaces</source>
        <translation>正在估计表面</translation>
    </message>
    <message>
        <source>every scene is rejected</source>
        <translation>所有场景均被剔除</translation>
    </message>
    <message>
        <source>exchange two axes, or the sign of one, in what writes the clouds</source>
        <translation>请在写出点云的程序中交换两个轴，或将其中一个轴反号</translation>
    </message>
    <message>
        <source>expected %1 numbers after &apos;%2:&apos;</source>
        <translation>“%2:”之后应为 %1 个数</translation>
    </message>
    <message>
        <source>expected 3 numbers in translation_m and 4 in quaternion_xyzw</source>
        <translation>translation_m 应有 3 个数，quaternion_xyzw 应有 4 个数</translation>
    </message>
    <message>
        <source>expected JSON with an object &quot;camera&quot;</source>
        <translation>应为含有对象“camera”的 JSON</translation>
    </message>
    <message>
        <source>expected PointCloud2 or CustomMsg</source>
        <translation>应为 PointCloud2 或 CustomMsg</translation>
    </message>
    <message>
        <source>field &apos;%1&apos; has TYPE %2 and SIZE %3, expected F with 4 or 8 or I or U with 1, 2, 4 or 8</source>
        <translation>字段“%1”的 TYPE 为 %2、SIZE 为 %3，应为 F 配 4 或 8，或者 I 或 U 配 1、2、4 或 8</translation>
    </message>
    <message>
        <source>field &apos;%1&apos; has the unknown type %2; expected 1 to 8</source>
        <translation>字段“%1”的类型 %2 未知；应为 1 到 8</translation>
    </message>
    <message>
        <source>field &apos;%1&apos; lies outside of a point: offset %2 in %3 bytes</source>
        <translation>字段“%1”超出了点的范围：偏移 %2，而每个点只有 %3 字节</translation>
    </message>
    <message>
        <source>file is too large: %1 bytes, expected at most %2</source>
        <translation>文件过大：%1 字节，最多应为 %2 字节</translation>
    </message>
    <message>
        <source>file not found</source>
        <translation>找不到文件</translation>
    </message>
    <message>
        <source>folder cannot be created: %1</source>
        <translation>无法创建文件夹：%1</translation>
    </message>
    <message>
        <source>folder cannot be created: a file is in the way</source>
        <translation>无法创建文件夹：有文件挡在该路径上</translation>
    </message>
    <message>
        <source>folder cannot be created: a file is in the way (%1)</source>
        <translation>无法创建文件夹：有文件挡在该路径上（%1）</translation>
    </message>
    <message>
        <source>folder cannot be created: no right to write to %1</source>
        <translation>无法创建文件夹：没有写入 %1 的权限</translation>
    </message>
    <message>
        <source>folder cannot be written: no right to do so</source>
        <translation>无法写入文件夹：没有权限</translation>
    </message>
    <message>
        <source>folder not found; expected images of the board, or a dataset</source>
        <translation>找不到文件夹；应为标定板的图像，或一个数据集</translation>
    </message>
    <message>
        <source>folder not found; expected one folder per scene in it</source>
        <translation>找不到文件夹；其中每个场景应有一个文件夹</translation>
    </message>
    <message>
        <source>give a YAML file with T_imu_lidar (takes a LiDAR point to the IMU frame) by --imu</source>
        <translation>请用 --imu 给出含有 T_imu_lidar（将激光雷达的点变换到 IMU 坐标系）的 YAML 文件</translation>
    </message>
    <message>
        <source>give a rough extrinsic with --init</source>
        <translation>请用 --init 给出粗略外参</translation>
    </message>
    <message>
        <source>give another folder</source>
        <translation>请指定另一个文件夹</translation>
    </message>
    <message>
        <source>give each scene its own image and cloud</source>
        <translation>请为每个场景提供各自的图像和点云</translation>
    </message>
    <message>
        <source>give every side a length above zero</source>
        <translation>请为每条边给出大于零的长度</translation>
    </message>
    <message>
        <source>give intrinsics with --camera FILE</source>
        <translation>请用 --camera FILE 给出内参</translation>
    </message>
    <message>
        <source>give the .db3 or .mcap file itself</source>
        <translation>请直接指定 .db3 或 .mcap 文件</translation>
    </message>
    <message>
        <source>give the result.json or result.yaml of a calibration</source>
        <translation>请指定一次标定的 result.json 或 result.yaml</translation>
    </message>
    <message>
        <source>give the result.json that lvcalib discover wrote</source>
        <translation>请指定 lvcalib discover 写出的 result.json</translation>
    </message>
    <message>
        <source>grid of board poses: expected distances above zero, tilts up to 80 degrees, at least one of each, and 1 to 20 cells</source>
        <translation>标定板位姿网格：距离应大于零，倾斜不超过 80 度，两者各至少一个，并应有 1 到 20 个单元格</translation>
    </message>
    <message>
        <source>has no field &apos;%1&apos;; expected x y z, found: %2</source>
        <translation>没有字段“%1”；应为 x y z，实际为：%2</translation>
    </message>
    <message>
        <source>holds no model</source>
        <translation>不含模型</translation>
    </message>
    <message>
        <source>holds no points (its header says 0)</source>
        <translation>不含点（文件头声明 0 个点）</translation>
    </message>
    <message>
        <source>image reduction must be at least 1</source>
        <translation>图像缩小倍数必须至少为 1</translation>
    </message>
    <message>
        <source>images have the encoding &apos;%1&apos;; read are mono, rgb, bgr (8 and 16 bit), rgba8, bgra8, bayer and yuv422</source>
        <translation>图像的编码为“%1”；可读取的是 mono、rgb、bgr（8 位和 16 位）、rgba8、bgra8、bayer 和 yuv422</translation>
    </message>
    <message>
        <source>in &apos;%1&apos;: %2</source>
        <translation>“%1”中：%2</translation>
    </message>
    <message>
        <source>in centimetres</source>
        <translation>以厘米为单位</translation>
    </message>
    <message>
        <source>in feet</source>
        <translation>以英尺为单位</translation>
    </message>
    <message>
        <source>in inches</source>
        <translation>以英寸为单位</translation>
    </message>
    <message>
        <source>in millimetres</source>
        <translation>以毫米为单位</translation>
    </message>
    <message>
        <source>is a folder, expected a PCD or PLY file</source>
        <translation>是文件夹，应为 PCD 或 PLY 文件</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>为空</translation>
    </message>
    <message>
        <source>is empty, expected a PCD or PLY file</source>
        <translation>为空，应为 PCD 或 PLY 文件</translation>
    </message>
    <message>
        <source>is missing</source>
        <translation>缺失</translation>
    </message>
    <message>
        <source>is missing or not a list</source>
        <translation>缺失或不是列表</translation>
    </message>
    <message>
        <source>is missing: the file tells values but not what they refer to</source>
        <translation>缺失：文件给出了数值，但没有说明它们的参照</translation>
    </message>
    <message>
        <source>is neither a PCD nor a PLY file</source>
        <translation>既不是 PCD 文件也不是 PLY 文件</translation>
    </message>
    <message>
        <source>is neither an lz4 nor a zstd file</source>
        <translation>既不是 lz4 文件也不是 zstd 文件</translation>
    </message>
    <message>
        <source>is no formula or curve: %1</source>
        <translation>不是公式或曲线：%1</translation>
    </message>
    <message>
        <source>is no list of numbers</source>
        <translation>不是数的列表</translation>
    </message>
    <message>
        <source>is no number</source>
        <translation>不是数</translation>
    </message>
    <message>
        <source>is not a project; expected &apos;format: lvcalib-project&apos;</source>
        <translation>不是项目文件；应有“format: lvcalib-project”</translation>
    </message>
    <message>
        <source>is not a value of &apos;%1&apos; in %2</source>
        <translation>不是“%1”以 %2 为单位的值</translation>
    </message>
    <message>
        <source>is not in ascending order</source>
        <translation>未按升序排列</translation>
    </message>
    <message>
        <source>is not rosbag2&apos;s: expected rosbag2_bagfile_information with relative_file_paths</source>
        <translation>不是 rosbag2 的文件：应为含有 relative_file_paths 的 rosbag2_bagfile_information</translation>
    </message>
    <message>
        <source>is not the list of %1 parameters that &apos;%2&apos; has</source>
        <translation>不是“%2”所具有的 %1 个参数的列表</translation>
    </message>
    <message>
        <source>is not two numbers</source>
        <translation>不是两个数</translation>
    </message>
    <message>
        <source>is truncated: it ends in element &apos;%1&apos; before any of its points</source>
        <translation>文件被截断：在元素“%1”中结束，尚未到达任何点</translation>
    </message>
    <message>
        <source>is truncated: its compressed data take %1 bytes, found %2, so none of %3 points can be read</source>
        <translation>文件被截断：压缩数据应占 %1 字节，实际为 %2 字节，因此 %3 个点均无法读取</translation>
    </message>
    <message>
        <source>is truncated: its header says %1 points, found %2</source>
        <translation>文件被截断：文件头声明 %1 个点，实际 %2 个</translation>
    </message>
    <message>
        <source>it is not a finite number on %1 of %2 rows of the channel %3</source>
        <translation>在通道 %3 的 %2 行中有 %1 行不是有限数</translation>
    </message>
    <message>
        <source>it is not linear in the coefficient %1</source>
        <translation>对系数 %1 不是线性的</translation>
    </message>
    <message>
        <source>it is not zero when its coefficients are</source>
        <translation>系数为零时其值不为零</translation>
    </message>
    <message>
        <source>it is off by %1 m and %2°</source>
        <translation>偏差为 %1 m 和 %2°</translation>
    </message>
    <message>
        <source>it is the inverse, with its translation in millimetres</source>
        <translation>它是逆变换，且平移以毫米为单位</translation>
    </message>
    <message>
        <source>it is the inverse: T_lidar_camera instead of T_camera_lidar</source>
        <translation>它是逆变换：是 T_lidar_camera 而不是 T_camera_lidar</translation>
    </message>
    <message>
        <source>it is there already, and counts once</source>
        <translation>已有相同的图像，只计一次</translation>
    </message>
    <message>
        <source>its PCD header claims more than 2^40 points</source>
        <translation>PCD 文件头声明的点数超过 2^40</translation>
    </message>
    <message>
        <source>its PCD header claims points of %1 bytes, expected at most %2</source>
        <translation>PCD 文件头声明每个点 %1 字节，最多应为 %2 字节</translation>
    </message>
    <message>
        <source>its PCD header does not agree with itself: %1 FIELDS, %2 SIZE, %3 TYPE, %4 COUNT entries</source>
        <translation>PCD 文件头自相矛盾：FIELDS 有 %1 项，SIZE %2 项，TYPE %3 项，COUNT %4 项</translation>
    </message>
    <message>
        <source>its PCD header does not agree with itself: POINTS is %1, WIDTH x HEIGHT is %2</source>
        <translation>PCD 文件头自相矛盾：POINTS 为 %1，WIDTH x HEIGHT 为 %2</translation>
    </message>
    <message>
        <source>its PCD header ends without a DATA line</source>
        <translation>PCD 文件头结束时没有 DATA 行</translation>
    </message>
    <message>
        <source>its PCD header lacks the number of points (POINTS, or WIDTH and HEIGHT)</source>
        <translation>PCD 文件头缺少点数（POINTS，或 WIDTH 和 HEIGHT）</translation>
    </message>
    <message>
        <source>its PLY header ends without an end_header line</source>
        <translation>PLY 文件头结束时没有 end_header 行</translation>
    </message>
    <message>
        <source>its PLY header has no element &apos;vertex&apos;</source>
        <translation>PLY 文件头没有元素“vertex”</translation>
    </message>
    <message>
        <source>its PLY header has no format line</source>
        <translation>PLY 文件头没有 format 行</translation>
    </message>
    <message>
        <source>its camera model &apos;%1&apos; has no counterpart here; expected plumb_bob or fisheye</source>
        <translation>其相机模型“%1”在此没有对应的模型；应为 plumb_bob 或 fisheye</translation>
    </message>
    <message>
        <source>its circles cannot be measured: %1</source>
        <translation>其圆无法测量：%1</translation>
    </message>
    <message>
        <source>its coefficient %1 changes nothing on any row</source>
        <translation>其系数 %1 在任何一行上都不起作用</translation>
    </message>
    <message>
        <source>its coefficients %1 cannot be told apart on these data</source>
        <translation>其系数 %1 在这些数据上无法区分</translation>
    </message>
    <message>
        <source>its coefficients do not act one by one: it is not linear in them</source>
        <translation>其各系数并非独立起作用：对它们不是线性的</translation>
    </message>
    <message>
        <source>its compressed data are damaged</source>
        <translation>其压缩数据已损坏</translation>
    </message>
    <message>
        <source>its compressed data cannot hold %1 points: %2 bytes are too few</source>
        <translation>其压缩数据不可能包含 %1 个点：%2 字节太少</translation>
    </message>
    <message>
        <source>its compressed data hold %1 bytes, expected %2 for %3 points</source>
        <translation>其压缩数据包含 %1 字节，应为 %2 字节，对应 %3 个点</translation>
    </message>
    <message>
        <source>its image has %1 × %2 px, the camera&apos;s have %3 × %4</source>
        <translation>其图像为 %1 × %2 px，而相机的图像为 %3 × %4</translation>
    </message>
    <message>
        <source>its rotation is the identity, but the sensors&apos; axes point in other directions</source>
        <translation>其旋转为单位旋转，但两个传感器的坐标轴指向不同</translation>
    </message>
    <message>
        <source>its translation is in millimetres</source>
        <translation>其平移以毫米为单位</translation>
    </message>
    <message>
        <source>key &apos;%1&apos; is missing</source>
        <translation>缺少键“%1”</translation>
    </message>
    <message>
        <source>labels of a curve: expected 2 or more</source>
        <translation>曲线的标签：应为 2 个或更多</translation>
    </message>
    <message>
        <source>leave one of them out</source>
        <translation>请去掉其中一个</translation>
    </message>
    <message>
        <source>leave this scene out</source>
        <translation>请弃用该场景</translation>
    </message>
    <message>
        <source>left</source>
        <translation>左侧</translation>
    </message>
    <message>
        <source>let the scanner dwell longer or bring the board nearer</source>
        <translation>请让扫描仪停留更久，或将标定板移近</translation>
    </message>
    <message>
        <source>line %1 is longer than a mebibyte; expected text</source>
        <translation>第 %1 行长度超过 1 MiB；应为文本</translation>
    </message>
    <message>
        <source>line %1: %2</source>
        <translation>第 %1 行：%2</translation>
    </message>
    <message>
        <source>lvcalib import --list shows all topics</source>
        <translation>lvcalib import --list 可显示所有话题</translation>
    </message>
    <message>
        <source>marker dictionary &apos;%1&apos; is not known</source>
        <translation>未知的标记字典“%1”</translation>
    </message>
    <message>
        <source>markers of %1 found; the target says %2</source>
        <translation>发现了 %1 的标记；而标定板描述为 %2</translation>
    </message>
    <message>
        <source>measure the print and correct target.yaml</source>
        <translation>请测量印刷图案并修正 target.yaml</translation>
    </message>
    <message>
        <source>measure the printed tags and correct tagSize</source>
        <translation>请测量打印的标签并修正 tagSize</translation>
    </message>
    <message>
        <source>messages are serialized as &apos;%1&apos;; ROS 1 and CDR are read</source>
        <translation>消息的序列化方式为“%1”；可读取的是 ROS 1 和 CDR</translation>
    </message>
    <message>
        <source>middle</source>
        <translation>中间</translation>
    </message>
    <message>
        <source>multiply every term with a coefficient</source>
        <translation>请将每一项乘以一个系数</translation>
    </message>
    <message>
        <source>no %1 in these clouds</source>
        <translation>这些点云中没有 %1</translation>
    </message>
    <message>
        <source>no LiDAR return lies on the board</source>
        <translation>没有激光雷达回波落在标定板上</translation>
    </message>
    <message>
        <source>no LiDAR return lies on the board where the start puts it</source>
        <translation>在初始外参给出的标定板位置上没有激光雷达回波</translation>
    </message>
    <message>
        <source>no board reached these parts of the image: %1; the distortion there is extrapolated</source>
        <translation>标定板未到达图像的这些部分：%1；那里的畸变是外推的</translation>
    </message>
    <message>
        <source>no camera fits the corners of the images</source>
        <translation>没有相机与这些图像的角点相符</translation>
    </message>
    <message>
        <source>no camera intrinsics found; expected the keys of ROS camera_info (camera_matrix, distortion_model), a Kalibr camchain (cam0) or OpenCV (camera_matrix)</source>
        <translation>找不到相机内参；应为 ROS camera_info 的键（camera_matrix、distortion_model）、Kalibr camchain（cam0）或 OpenCV（camera_matrix）</translation>
    </message>
    <message>
        <source>no checkerboard with %1 × %2 inner corners in the image</source>
        <translation>图像中没有具有 %1 × %2 个内角点的棋盘格</translation>
    </message>
    <message>
        <source>no circle gives boundary samples</source>
        <translation>没有圆给出边界样本</translation>
    </message>
    <message>
        <source>no data can tell it from a turn of the LiDAR frame</source>
        <translation>任何数据都无法将它与激光雷达坐标系的旋转区分开</translation>
    </message>
    <message>
        <source>no images; expected png, jpg, bmp or tiff files that show the board</source>
        <translation>没有图像；应为显示标定板的 png、jpg、bmp 或 tiff 文件</translation>
    </message>
    <message>
        <source>no plane fits the board&apos;s %1 LiDAR points; at least ten, not all on one scan line, are needed</source>
        <translation>没有平面与标定板的 %1 个激光雷达点相符；至少需要十个点，且不能都在同一条扫描线上</translation>
    </message>
    <message>
        <source>no scenes; expected folders with image.png and cloud.pcd</source>
        <translation>没有场景；应为含有 image.png 和 cloud.pcd 的文件夹</translation>
    </message>
    <message>
        <source>no tags in the image</source>
        <translation>图像中没有标签</translation>
    </message>
    <message>
        <source>no temporary file can be made</source>
        <translation>无法创建临时文件</translation>
    </message>
    <message>
        <source>no usable scene is left</source>
        <translation>没有剩下可用的场景</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>none of its %1 pairs can be used</source>
        <translation>其 %1 对文件均不可用</translation>
    </message>
    <message>
        <source>none of its %1 points is usable: all are NaN, infinite or at the origin</source>
        <translation>其 %1 个点均不可用：都是 NaN、无穷大或位于原点</translation>
    </message>
    <message>
        <source>none of the files that it names is there</source>
        <translation>它列出的文件都不存在</translation>
    </message>
    <message>
        <source>not a JSON object</source>
        <translation>不是 JSON 对象</translation>
    </message>
    <message>
        <source>not a regular file</source>
        <translation>不是普通文件</translation>
    </message>
    <message>
        <source>not an image that can be read; expected png, jpg, bmp or tiff</source>
        <translation>不是可读取的图像；应为 png、jpg、bmp 或 tiff</translation>
    </message>
    <message>
        <source>nothing stands still at %1 s</source>
        <translation>在 %1 s 处没有静止时段</translation>
    </message>
    <message>
        <source>one image only: nothing checks it; take ten or more, the board turned differently in each</source>
        <translation>只有一张图像：无法对其进行检验；请拍摄十张或更多，每张中标定板的朝向各不相同</translation>
    </message>
    <message>
        <source>only %1 images: take ten or more, the board turned differently in each</source>
        <translation>只有 %1 张图像：请拍摄十张或更多，每张中标定板的朝向各不相同</translation>
    </message>
    <message>
        <source>only %1 of the %2 tags seen lie where the target has them</source>
        <translation>所见的 %2 个标签中只有 %1 个位于标定板描述的位置</translation>
    </message>
    <message>
        <source>only %1 of the board&apos;s %2 tags found, expected at least %3</source>
        <translation>标定板的 %2 个标签中只找到 %1 个，应至少为 %3 个</translation>
    </message>
    <message>
        <source>open it with a newer release; it was not changed</source>
        <translation>请用更新的版本打开；文件未被改动</translation>
    </message>
    <message>
        <source>open the project and say where the dataset is now, then save it</source>
        <translation>请打开项目并指明数据集现在的位置，然后保存</translation>
    </message>
    <message>
        <source>overlap and page border must not be negative</source>
        <translation>重叠和页边距不得为负</translation>
    </message>
    <message>
        <source>page %1 of %2</source>
        <translation>第 %1 页，共 %2 页</translation>
    </message>
    <message>
        <source>paper &apos;%1&apos; has no room; expected sides of %2 to %3 mm</source>
        <translation>纸张“%1”放不下；边长应为 %2 到 %3 mm</translation>
    </message>
    <message>
        <source>paper &apos;%1&apos; is not known; expected board, A0, A1, A2, A3, A4, Letter or WxH in mm</source>
        <translation>未知的纸张“%1”；应为 board、A0、A1、A2、A3、A4、Letter 或以 mm 为单位的 WxH</translation>
    </message>
    <message>
        <source>planning: expected a corner noise and a threshold above zero</source>
        <translation>规划：角点噪声与阈值应大于零</translation>
    </message>
    <message>
        <source>plumb_bob, rational_polynomial or equidistant</source>
        <translation>plumb_bob、rational_polynomial 或 equidistant</translation>
    </message>
    <message>
        <source>quaternion_xyzw must have length 1</source>
        <translation>quaternion_xyzw 的长度必须为 1</translation>
    </message>
    <message>
        <source>reading the index</source>
        <translation>正在读取索引</translation>
    </message>
    <message>
        <source>reading through the bag</source>
        <translation>正在从头读取 bag</translation>
    </message>
    <message>
        <source>reading through the file</source>
        <translation>正在从头读取文件</translation>
    </message>
    <message>
        <source>record the cloud with %1, or leave the effect in with --skip %2</source>
        <translation>请录制带有 %1 的点云，或用 --skip %2 保留该效应</translation>
    </message>
    <message>
        <source>rename the folder</source>
        <translation>请重命名文件夹</translation>
    </message>
    <message>
        <source>right</source>
        <translation>右</translation>
    </message>
    <message>
        <source>run lvcalib discover again</source>
        <translation>请重新运行 lvcalib discover</translation>
    </message>
    <message>
        <source>run lvcalib discover again, or remove the file</source>
        <translation>请重新运行 lvcalib discover，或删除该文件</translation>
    </message>
    <message>
        <source>save it as 8 or 16 bit png</source>
        <translation>请将其另存为 8 位或 16 位 png</translation>
    </message>
    <message>
        <source>save the image as png</source>
        <translation>请将图像另存为 png</translation>
    </message>
    <message>
        <source>save them as YAML: OpenCV&apos;s FileStorage does for a name ending in .yaml</source>
        <translation>请将其另存为 YAML：文件名以 .yaml 结尾时，OpenCV 的 FileStorage 即保存为 YAML</translation>
    </message>
    <message>
        <source>scene %1: its image cannot be read</source>
        <translation>场景 %1：其图像无法读取</translation>
    </message>
    <message>
        <source>scene %1: its image is no longer at the dataset&apos;s place; the report goes without it</source>
        <translation>场景 %1：其图像已不在数据集所在位置；报告中不含该图像</translation>
    </message>
    <message>
        <source>scenes to plan: expected 1 to 100, found %1</source>
        <translation>要规划的场景数：应为 1 到 100，实际为 %1</translation>
    </message>
    <message>
        <source>set dictionary: %1</source>
        <translation>请设置 dictionary: %1</translation>
    </message>
    <message>
        <source>set legacyPattern: %1</source>
        <translation>请设置 legacyPattern: %1</translation>
    </message>
    <message>
        <source>set tagBorder: %1</source>
        <translation>请设置 tagBorder: %1</translation>
    </message>
    <message>
        <source>set tagFamily: %1 and tagBorder: %2</source>
        <translation>请设置 tagFamily: %1 和 tagBorder: %2</translation>
    </message>
    <message>
        <source>show it nearer or sharper</source>
        <translation>请将其放得更近或拍得更清晰</translation>
    </message>
    <message>
        <source>show more of the board, nearer, sharper or better lit</source>
        <translation>请让标定板露出更多、更近、更清晰或光照更好</translation>
    </message>
    <message>
        <source>splines of users&apos; curves: expected 5 to 100, or 5 to 20 along each of two</source>
        <translation>用户曲线的样条数：应为 5 到 100，或在两个方向上各为 5 到 20</translation>
    </message>
    <message>
        <source>stopped by the user</source>
        <translation>已被用户停止</translation>
    </message>
    <message>
        <source>tag border must be 1 or 2 bits</source>
        <translation>标签边框必须为 1 位或 2 位</translation>
    </message>
    <message>
        <source>tag family &apos;%1&apos; is not known</source>
        <translation>未知的标签族“%1”</translation>
    </message>
    <message>
        <source>tag ids beyond the %1 of %2</source>
        <translation>标签编号超出 %2 的 %1 个标签</translation>
    </message>
    <message>
        <source>tagSpacing: about %1</source>
        <translation>tagSpacing: 约 %1</translation>
    </message>
    <message>
        <source>tags of family %1 with a %2 found; the target says %3</source>
        <translation>找到的是标签族 %1、%2的标签；标定板描述的是 %3</translation>
    </message>
    <message>
        <source>tags that miss the board&apos;s pose were dropped: %1</source>
        <translation>偏离标定板位姿的标签已丢弃：%1</translation>
    </message>
    <message>
        <source>take images of the board turned by 20° to 45°, another way each time</source>
        <translation>请拍摄标定板转动 20° 到 45° 的图像，每次转向不同方向</translation>
    </message>
    <message>
        <source>take scenes with the board tilted left, right, up and down</source>
        <translation>请拍摄标定板向左、右、上、下倾斜的场景</translation>
    </message>
    <message>
        <source>taking effects out</source>
        <translation>正在去除效应</translation>
    </message>
    <message>
        <source>the %1 file ends early or is damaged</source>
        <translation>%1 文件提前结束或已损坏</translation>
    </message>
    <message>
        <source>the board is larger than a PDF page can be (%1 mm)</source>
        <translation>标定板大于 PDF 页面的最大尺寸（%1 mm）</translation>
    </message>
    <message>
        <source>the board is not found in any cloud (%1)</source>
        <translation>在任何点云中都找不到标定板（%1）</translation>
    </message>
    <message>
        <source>the board is not found in any image; scene %1: %2</source>
        <translation>在任何图像中都找不到标定板；场景 %1：%2</translation>
    </message>
    <message>
        <source>the board is not found in any image; the first: %1</source>
        <translation>在任何图像中都找不到标定板；第一幅：%1</translation>
    </message>
    <message>
        <source>the board must be in view, sharp, and neither dark nor overexposed</source>
        <translation>标定板须在视野内、清晰，且既不过暗也不过曝</translation>
    </message>
    <message>
        <source>the board takes %1 pages of %2, but only a PDF has several pages</source>
        <translation>标定板需要 %1 页 %2，但只有 PDF 能有多页</translation>
    </message>
    <message>
        <source>the board would take more than %1 pages of %2</source>
        <translation>标定板将需要超过 %1 页 %2</translation>
    </message>
    <message>
        <source>the board&apos;s start pose puts some of its corners where the camera cannot see them</source>
        <translation>按标定板的起始位姿，其部分角点位于相机看不到的地方</translation>
    </message>
    <message>
        <source>the board, or one with the same tags, is in the image twice</source>
        <translation>图像中两次出现该标定板或标签相同的标定板</translation>
    </message>
    <message>
        <source>the boards are turned by no more than %1° against each other: the focal length rests on little; turn the board by 20° to 45°, another way each time</source>
        <translation>各标定板之间的相对转角不超过 %1°：焦距的依据不足；请将标定板转动 20° 到 45°，每次转向不同方向</translation>
    </message>
    <message>
        <source>the boundary response of this result is malformed: %1</source>
        <translation>此结果的边界响应格式有误：%1</translation>
    </message>
    <message>
        <source>the camera is not calibrated: fx is 0</source>
        <translation>相机未标定：fx 为 0</translation>
    </message>
    <message>
        <source>the camera&apos;s size is absurd</source>
        <translation>相机的图像尺寸不合理</translation>
    </message>
    <message>
        <source>the clock is %1, expected 0 to 1</source>
        <translation>时序为 %1，应为 0 到 1</translation>
    </message>
    <message>
        <source>the corners do not determine the board&apos;s pose</source>
        <translation>这些角点不足以确定标定板的位姿</translation>
    </message>
    <message>
        <source>the corners fit no pose of a flat board</source>
        <translation>这些角点不符合平面标定板的任何位姿</translation>
    </message>
    <message>
        <source>the crop box has no volume</source>
        <translation>裁剪框没有体积</translation>
    </message>
    <message>
        <source>the distortion folds back inside the image: %1 of its 4 corners have no ray; take images with the board there</source>
        <translation>畸变在图像内部折返：4 个角中有 %1 个没有对应的射线；请拍摄标定板位于该处的图像</translation>
    </message>
    <message>
        <source>the distortion is off by up to %1 px on the boards</source>
        <translation>畸变在标定板上的偏差最大达 %1 px</translation>
    </message>
    <message>
        <source>the edges of LiDAR and image meet no better than by chance, here and nearby: the pose is wrong by more than what is searched, or the two do not show the same</source>
        <translation>激光雷达与图像的边缘在此处及附近的吻合都不优于偶然：位姿误差超出搜索范围，或两者所示并非同一场景</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; cannot be taken out: the model lacks the calibration&apos;s intensities</source>
        <translation>无法去除效应“%1”：模型中没有标定时的强度</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; cannot be taken out: there is no %2 in this cloud</source>
        <translation>无法去除效应“%1”：该点云中没有 %2</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; cannot be used: it acts just as %2 do, which makes the solve singular</source>
        <translation>无法使用效应“%1”：其作用与%2完全相同，使求解奇异</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; is not in the model</source>
        <translation>效应“%1”不在模型中</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; lacks the interval of %2, expected &apos;%3[low..high]&apos;</source>
        <translation>效应“%1”缺少%2的区间，应为“%3[low..high]”</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; takes %2 finite values</source>
        <translation>效应“%1”需要 %2 个有限值</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; to skip is not in the model</source>
        <translation>要跳过的效应“%1”不在模型中</translation>
    </message>
    <message>
        <source>the effect &apos;%1&apos; was asked for twice; it is taken once</source>
        <translation>效应“%1”被要求了两次；只采用一次</translation>
    </message>
    <message>
        <source>the extrinsic and the board poses</source>
        <translation>外参和标定板位姿</translation>
    </message>
    <message>
        <source>the file is not the one that the result was made of: its content changed</source>
        <translation>该文件不是得出此结果的文件：其内容已改变</translation>
    </message>
    <message>
        <source>the focal length is %1 ± %2 % too long</source>
        <translation>焦距偏长 %1 ± %2 %</translation>
    </message>
    <message>
        <source>the focal length is %1 ± %2 % too short</source>
        <translation>焦距偏短 %1 ± %2 %</translation>
    </message>
    <message>
        <source>the format %1 holds the camera&apos;s pose in the IMU frame and needs T_imu_lidar</source>
        <translation>格式 %1 保存相机在 IMU 坐标系中的位姿，需要 T_imu_lidar</translation>
    </message>
    <message>
        <source>the image (or the print) is mirrored: its tags can be read in a mirror</source>
        <translation>图像（或印刷图案）被镜像：其标签在镜中才能读出</translation>
    </message>
    <message>
        <source>the image cannot be decoded: its data are damaged</source>
        <translation>图像无法解码：数据已损坏</translation>
    </message>
    <message>
        <source>the image cannot be searched for a checkerboard</source>
        <translation>无法在该图像中搜索棋盘格</translation>
    </message>
    <message>
        <source>the image cannot be searched for markers</source>
        <translation>无法在该图像中搜索标记</translation>
    </message>
    <message>
        <source>the image claims %1 × %2 pixels; expected 1 to %3 in all</source>
        <translation>图像声称有 %1 × %2 像素；总像素数应为 1 到 %3</translation>
    </message>
    <message>
        <source>the image could not be encoded as JPEG</source>
        <translation>图像无法编码为 JPEG</translation>
    </message>
    <message>
        <source>the image could not be encoded as PNG</source>
        <translation>图像无法编码为 PNG</translation>
    </message>
    <message>
        <source>the image file is empty</source>
        <translation>图像文件为空</translation>
    </message>
    <message>
        <source>the image has %1 pixels, the intrinsics are for %2</source>
        <translation>图像为 %1 像素，而内参对应 %2</translation>
    </message>
    <message>
        <source>the image has %1 × %2 pixels, %3 has %4 × %5</source>
        <translation>图像为 %1 × %2 像素，而 %3 为 %4 × %5</translation>
    </message>
    <message>
        <source>the image has %1 × %2 pixels, the given intrinsics are for %3 × %4</source>
        <translation>图像为 %1 × %2 像素，而给定的内参对应 %3 × %4</translation>
    </message>
    <message>
        <source>the image has neither 8 nor 16 bits per channel</source>
        <translation>图像每通道既非 8 位也非 16 位</translation>
    </message>
    <message>
        <source>the image has no pixels</source>
        <translation>图像没有像素</translation>
    </message>
    <message>
        <source>the image has no pixels, so no PNG can be made of it</source>
        <translation>图像没有像素，因此无法生成 PNG</translation>
    </message>
    <message>
        <source>the image shows tags %1 of %2; the target has %3</source>
        <translation>图像中有 %2 的标签 %1；标定板描述的是 %3</translation>
    </message>
    <message>
        <source>the image size must be positive, found %1 × %2</source>
        <translation>图像尺寸必须为正，实际为 %1 × %2</translation>
    </message>
    <message>
        <source>the image would be %1 pixels long, more than 32767</source>
        <translation>图像将长达 %1 像素，超过 32767</translation>
    </message>
    <message>
        <source>the images contradict target.yaml: %1</source>
        <translation>图像与 target.yaml 矛盾：%1</translation>
    </message>
    <message>
        <source>the images contradict target.yaml: %1; measure the print</source>
        <translation>图像与 target.yaml 矛盾：%1；请测量印刷图案</translation>
    </message>
    <message>
        <source>the images do not determine the focal length: %1 ± %2 px, known to %3 % where %4 % is the most that counts as a result</source>
        <translation>这些图像不足以确定焦距：%1 ± %2 px，精度为 %3 %，而超过 %4 % 便不能算作结果</translation>
    </message>
    <message>
        <source>the joint solve fails on these observations</source>
        <translation>联合求解在这些观测上失败</translation>
    </message>
    <message>
        <source>the largest reprojection error must be positive and the image reduction at least 1</source>
        <translation>最大重投影误差必须为正，图像缩小倍数至少为 1</translation>
    </message>
    <message>
        <source>the left 3×3 part of %1 is not a rotation</source>
        <translation>%1 左侧的 3×3 部分不是旋转矩阵</translation>
    </message>
    <message>
        <source>the left 3×3 part of &apos;%1&apos; is not a rotation</source>
        <translation>“%1”左侧的 3×3 部分不是旋转矩阵</translation>
    </message>
    <message>
        <source>the markers lie as on a board with legacyPattern: %1</source>
        <translation>标记的排列与 legacyPattern: %1 的标定板相符</translation>
    </message>
    <message>
        <source>the messages of %1 are serialized as &apos;%2&apos;; ROS 1 and CDR are read</source>
        <translation>%1 的消息以“%2”序列化；可读取的是 ROS 1 和 CDR</translation>
    </message>
    <message>
        <source>the principal point (%1, %2) px lies far outside the image of %3 × %4 px</source>
        <translation>主点 (%1, %2) px 远在 %3 × %4 px 的图像之外</translation>
    </message>
    <message>
        <source>the principal point is off by %1 px across and %2 px down</source>
        <translation>主点横向偏差 %1 px，纵向偏差 %2 px</translation>
    </message>
    <message>
        <source>the project has format version %1, this program knows up to %2</source>
        <translation>项目的格式版本为 %1，本程序最高支持 %2</translation>
    </message>
    <message>
        <source>the project&apos;s dataset is not there</source>
        <translation>找不到项目的数据集</translation>
    </message>
    <message>
        <source>the resolution must be between 1 and 10000 dpi</source>
        <translation>分辨率必须在 1 到 10000 dpi 之间</translation>
    </message>
    <message>
        <source>the rotation of the crop box is not a unit quaternion</source>
        <translation>裁剪框的旋转不是单位四元数</translation>
    </message>
    <message>
        <source>the same image as %1, which counts once</source>
        <translation>与 %1 的图像相同，只计一次</translation>
    </message>
    <message>
        <source>the sheet cannot be drawn: %1</source>
        <translation>无法绘制标定板图纸：%1</translation>
    </message>
    <message>
        <source>the tag in the image is too small or too blurred</source>
        <translation>图像中的标签太小或太模糊</translation>
    </message>
    <message>
        <source>the tags in the image have a %1; the target says %2</source>
        <translation>图像中的标签为%1；标定板描述的是%2</translation>
    </message>
    <message>
        <source>the tags lie as on a board %1</source>
        <translation>标签的排列与这样的标定板相符：%1</translation>
    </message>
    <message>
        <source>there is already a scene &apos;%1&apos; in this dataset</source>
        <translation>此数据集中已有场景“%1”</translation>
    </message>
    <message>
        <source>there is no boundary response to export: %1</source>
        <translation>没有可导出的边界响应：%1</translation>
    </message>
    <message>
        <source>there is no camera in this result</source>
        <translation>此结果中没有相机</translation>
    </message>
    <message>
        <source>there is no format &apos;%1&apos;, known are %2</source>
        <translation>没有格式“%1”，已知的有 %2</translation>
    </message>
    <message>
        <source>there is no image</source>
        <translation>没有图像</translation>
    </message>
    <message>
        <source>there is no image at this time</source>
        <translation>此时刻没有图像</translation>
    </message>
    <message>
        <source>there is no scene &apos;%1&apos; to reject</source>
        <translation>没有可剔除的场景“%1”</translation>
    </message>
    <message>
        <source>there is no scene &apos;%1&apos; with image and cloud, known are %2</source>
        <translation>没有同时含图像和点云的场景“%1”，已知的有 %2</translation>
    </message>
    <message>
        <source>these data have no rows of its channel</source>
        <translation>这些数据没有其通道的行</translation>
    </message>
    <message>
        <source>this is an image; lvcalib calibrate takes a folder of scenes</source>
        <translation>这是一幅图像；lvcalib calibrate 需要场景文件夹</translation>
    </message>
    <message>
        <source>this result holds no boundary response</source>
        <translation>此结果不含边界响应</translation>
    </message>
    <message>
        <source>this result lacks what a report shows: %1</source>
        <translation>此结果缺少报告所要显示的内容：%1</translation>
    </message>
    <message>
        <source>tile it over several pages with --paper A0</source>
        <translation>请用 --paper A0 将其分成多页</translation>
    </message>
    <message>
        <source>times count from the first message; without --scenes all still stretches are found</source>
        <translation>时间从第一条消息算起；不加 --scenes 则查找全部静止时段</translation>
    </message>
    <message>
        <source>too few edges of the LiDAR are in the picture: %1 in %2 parts of it, where %3 in %4 are needed</source>
        <translation>画面中的激光雷达边缘太少：%2 个部分中有 %1 条，而需要 %4 个部分中有 %3 条</translation>
    </message>
    <message>
        <source>top</source>
        <translation>上</translation>
    </message>
    <message>
        <source>top left</source>
        <translation>左上</translation>
    </message>
    <message>
        <source>top right</source>
        <translation>右上</translation>
    </message>
    <message>
        <source>topic &apos;%1&apos; holds no messages</source>
        <translation>话题“%1”不含消息</translation>
    </message>
    <message>
        <source>topic &apos;%1&apos; is of another type</source>
        <translation>话题“%1”是另一种类型</translation>
    </message>
    <message>
        <source>topic &apos;%1&apos; was not recorded</source>
        <translation>话题“%1”未被录制</translation>
    </message>
    <message>
        <source>turn off flipping in the camera driver, or print the board again</source>
        <translation>请在相机驱动中关闭翻转，或重新打印标定板</translation>
    </message>
    <message>
        <source>two checkerboards of this size are in the image</source>
        <translation>图像中有两块该尺寸的棋盘格</translation>
    </message>
    <message>
        <source>unknown change &apos;%1&apos; (add, remove, off, on, hold or release)</source>
        <translation>未知的更改“%1”（add、remove、off、on、hold 或 release）</translation>
    </message>
    <message>
        <source>unknown option &apos;%1&apos; ignored</source>
        <translation>已忽略未知选项“%1”</translation>
    </message>
    <message>
        <source>unknown option &apos;%1&apos; ignored; did you mean &apos;%2&apos;?</source>
        <translation>已忽略未知选项“%1”；您是指“%2”吗？</translation>
    </message>
    <message>
        <source>unpack the file first, or give TMPDIR a place with more room</source>
        <translation>请先解压该文件，或将 TMPDIR 指向空间更大的位置</translation>
    </message>
    <message>
        <source>unpacking %1</source>
        <translation>正在解压 %1</translation>
    </message>
    <message>
        <source>use --dpi %1 or a PDF</source>
        <translation>请使用 --dpi %1 或 PDF</translation>
    </message>
    <message>
        <source>use a board as lvcalib target draws it: tags upright, ids from the bottom left</source>
        <translation>请使用 lvcalib target 所绘制的标定板：标签正立，编号从左下角开始</translation>
    </message>
    <message>
        <source>use images of one camera at one resolution</source>
        <translation>请使用同一相机、同一分辨率的图像</translation>
    </message>
    <message>
        <source>use the intrinsics of this camera at this resolution</source>
        <translation>请使用该相机在此分辨率下的内参</translation>
    </message>
    <message>
        <source>use the version that wrote the file, or run lvcalib discover again</source>
        <translation>请使用写出该文件的版本，或重新运行 lvcalib discover</translation>
    </message>
    <message>
        <source>where the edges agree is known to %1 px only: take a place with more edges, near and far and all over the picture</source>
        <translation>边缘吻合的位置只能确定到 %1 px：请选择边缘更多、远近皆有且遍布整个画面的场所</translation>
    </message>
    <message>
        <source>whose ids grow from the bottom right</source>
        <translation>编号从右下角开始递增</translation>
    </message>
    <message>
        <source>whose ids grow from the top left</source>
        <translation>编号从左上角开始递增</translation>
    </message>
    <message>
        <source>whose ids grow from the top right</source>
        <translation>编号从右上角开始递增</translation>
    </message>
    <message>
        <source>whose tags are each turned by %1°</source>
        <translation>每个标签各转了 %1°</translation>
    </message>
    <message>
        <source>with the camera found</source>
        <translation>使用求得的相机</translation>
    </message>
    <message>
        <source>write a PDF, or leave the paper at &apos;board&apos;</source>
        <translation>请输出 PDF，或将纸张保持为“board”</translation>
    </message>
    <message>
        <source>write a number in its place, such as the 3 in &apos;a*sin(3*azimuth)&apos;</source>
        <translation>请在其位置写一个数，例如“a*sin(3*azimuth)”中的 3</translation>
    </message>
    <message>
        <source>write a sum of terms with one coefficient each</source>
        <translation>请写成各项之和，每项一个系数</translation>
    </message>
    <message>
        <source>your own: formula:CHANNEL:EXPRESSION or curve:CHANNEL:COVARIATE</source>
        <translation>您自己的：formula:CHANNEL:EXPRESSION 或 curve:CHANNEL:COVARIATE</translation>
    </message>
    <message>
        <source>Echoes above a certain power are clipped: bright print near the LiDAR reads darker than it is, its edges lie off, and its range is wrong.</source>
        <translation>超过一定功率的回波被截断：靠近激光雷达的明亮印刷面读数偏暗，其边缘偏移，距离也有误差。</translation>
    </message>
    <message>
        <source>Receiver saturation</source>
        <translation>接收器饱和</translation>
    </message>
    <message>
        <source>boards from close by to far away, square to the beam</source>
        <translation>由近到远、正对光束的标定板</translation>
    </message>
    <message>
        <source>ln Ps, of white at 3 m</source>
        <translation>ln Ps，相对于 3 m 处的白色</translation>
    </message>
    <message>
        <source>Beside a curve over what is left in the %1 channel it is not there: %2; something that no effect explains is at work.</source>
        <translation>与描述%1通道残余的曲线并列时，该效应不存在：%2；起作用的是没有任何效应能解释的其他因素。</translation>
    </message>
    <message>
        <source>%1 + %2</source>
        <translation>%1 + %2</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1、%2</translation>
    </message>
    <message>
        <source>Base model</source>
        <translation>基础模型</translation>
    </message>
    <message>
        <source>The pose is for clouds as the LiDAR gives them.</source>
        <translation>该位姿适用于激光雷达直接给出的点云。</translation>
    </message>
    <message>
        <source>The pose is for clouds with this taken out: %1 (lvcalib correct). Clouds as the LiDAR gives them are still off by it.</source>
        <translation>该位姿适用于已去除以下效应的点云：%1（lvcalib correct）。激光雷达直接给出的点云仍带有该误差。</translation>
    </message>
    <message>
        <source>the same pose as from %1 s to %2 s, which is kept</source>
        <translation>与 %1 s 至 %2 s 的位姿相同，保留后者</translation>
    </message>
    <message>
        <source>In total: with what usual faults could still do that these scenes do not show.</source>
        <translation>总计：再加上这些场景看不出的常见误差可能造成的影响。</translation>
    </message>
    <message>
        <source>It cannot be told which clouds the pose is for: its model is not whole.</source>
        <translation>无法判断该位姿适用于哪种点云：其模型不完整。</translation>
    </message>
    <message>
        <source>%1, as if cx and cy were exchanged</source>
        <translation>%1，像是 cx 与 cy 互换了</translation>
    </message>
    <message>
        <source>it contradicts the others only without the effects of this model: use it all the same (--insist) and search again</source>
        <translation>只有在不含该模型的效应时，它才与其他场景矛盾：请仍然使用它（--insist）并重新搜索</translation>
    </message>
    <message>
        <source>anisotropy</source>
        <translation>各向异性</translation>
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
        <source>horizontal</source>
        <translation>水平</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>比例</translation>
    </message>
    <message>
        <source>shear</source>
        <translation>剪切</translation>
    </message>
    <message>
        <source>vertical</source>
        <translation>垂直</translation>
    </message>
    <message>
        <source>A = print * N(0, S), S += ½ diag(a, −a), a = γh² − γv²</source>
        <translation>A = 印刷图案 * N(0, S), S += ½ diag(a, −a), a = γh² − γv²</translation>
    </message>
    <message>
        <source>A = print * N(0, S), S += γ² I</source>
        <translation>A = 印刷图案 * N(0, S), S += γ² I</translation>
    </message>
    <message>
        <source>I = (true I)^(1+g): the mid-level crossing of edges moves</source>
        <translation>I = (真实 I)^(1+g)：边缘的半高交点移动</translation>
    </message>
    <message>
        <source>angle error o/r</source>
        <translation>角度误差 o/r</translation>
    </message>
    <message>
        <source>corners move by b away from the tag&apos;s centre in the image</source>
        <translation>角点在图像中背离标签中心移动 b</translation>
    </message>
    <message>
        <source>dd = r (βh cos ψ&apos; + βv sin ψ&apos;), in the board: over cos θ up the slope</source>
        <translation>dd = r (βh cos ψ&apos; + βv sin ψ&apos;)，在标定板面内沿坡向上除以 cos θ</translation>
    </message>
    <message>
        <source>dd = v τ cos(scan direction - ψ), in the board: over cos θ up the slope</source>
        <translation>dd = v τ cos(扫描方向 - ψ)，在标定板面内沿坡向上除以 cos θ</translation>
    </message>
    <message>
        <source>del = b(line), daz = c(line), each with sum zero</source>
        <translation>del = b(线), daz = c(线)，各自之和为零</translation>
    </message>
    <message>
        <source>direction shifted by τ ω</source>
        <translation>方向移动 τ ω</translation>
    </message>
    <message>
        <source>dr = a g(P), g = 0 for the usual white and 1 for the usual black, a power of 1/P or ln P; P from the intensity, or from print, range and incidence</source>
        <translation>dr = a g(P)，通常的白色处 g = 0，通常的黑色处 g = 1，为 1/P 的幂或 ln P；P 取自强度，或由印刷图案、距离和入射角推得</translation>
    </message>
    <message>
        <source>dr = a τ (1 - exp(-t/τ)), t from the start of the scan</source>
        <translation>dr = a τ (1 - exp(-t/τ))，t 从扫描开始计</translation>
    </message>
    <message>
        <source>dr = a(line), sum zero</source>
        <translation>dr = a(线)，和为零</translation>
    </message>
    <message>
        <source>dr = b exp(-t/τ) over the order of the scenes</source>
        <translation>dr = b exp(-t/τ)，按场景的先后次序</translation>
    </message>
    <message>
        <source>du = y/H (v (1+x²) + w x y), dv = y/H (v x y + w (1+y²)), y/H the row</source>
        <translation>du = y/H (v (1+x²) + w x y), dv = y/H (v x y + w (1+y²))，y/H 为行的位置</translation>
    </message>
    <message>
        <source>dx = x (k ρ²) + tangential (p1, p2)</source>
        <translation>dx = x (k ρ²) + 切向项 (p1, p2)</translation>
    </message>
    <message>
        <source>edges move out by g</source>
        <translation>边缘外移 g</translation>
    </message>
    <message>
        <source>ln I = n ln cos θ - p ln r + g(line)</source>
        <translation>ln I = n ln cos θ - p ln r + g(线)</translation>
    </message>
    <message>
        <source>x = ln(P/Ps) where the power P exceeds Ps, else 0; dr = a x, ln I -= c x</source>
        <translation>功率 P 超过 Ps 处 x = ln(P/Ps)，否则为 0；dr = a x, ln I -= c x</translation>
    </message>
    <message>
        <source>z = kx (1-x²) + ky (1-y²) + kxy x y, x and y from -1 to 1</source>
        <translation>z = kx (1-x²) + ky (1-y²) + kxy x y，x 和 y 从 -1 到 1</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1 或 %2</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>轴</translation>
    </message>
    <message>
        <source>board radius</source>
        <translation>板面半径</translation>
    </message>
    <message>
        <source>board x</source>
        <translation>板面 x</translation>
    </message>
    <message>
        <source>board y</source>
        <translation>板面 y</translation>
    </message>
    <message>
        <source>circle</source>
        <translation>圆</translation>
    </message>
    <message>
        <source>contrast</source>
        <translation>对比度</translation>
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
        <source>distance to edge</source>
        <translation>到边缘的距离</translation>
    </message>
    <message>
        <source>image radius</source>
        <translation>图像半径</translation>
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
        <source>incidence</source>
        <translation>入射角</translation>
    </message>
    <message>
        <source>inverse range</source>
        <translation>距离倒数</translation>
    </message>
    <message>
        <source>laser line</source>
        <translation>激光线</translation>
    </message>
    <message>
        <source>polar angle</source>
        <translation>极角</translation>
    </message>
    <message>
        <source>polar angle to LiDAR axes</source>
        <translation>相对激光雷达轴的极角</translation>
    </message>
    <message>
        <source>polar angle to tilt</source>
        <translation>相对倾斜的极角</translation>
    </message>
    <message>
        <source>print</source>
        <translation>印刷</translation>
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
        <source>scan across edge</source>
        <translation>横过边缘的扫描</translation>
    </message>
    <message>
        <source>scan direction</source>
        <translation>扫描方向</translation>
    </message>
    <message>
        <source>scan speed</source>
        <translation>扫描速度</translation>
    </message>
    <message>
        <source>scene clock</source>
        <translation>场景时序</translation>
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
        <source>tag size</source>
        <translation>标签大小</translation>
    </message>
    <message>
        <source>tilt direction</source>
        <translation>倾斜方向</translation>
    </message>
    <message>
        <source>time in scan</source>
        <translation>扫描内时间</translation>
    </message>
    <message>
        <source>%1, or %2</source>
        <translation>%1，或%2</translation>
    </message>
    <message>
        <source>It leaves most of what is at one place as it is: %1; something that no effect explains is at work.</source>
        <translation>它使某一位置上的残余大部分保持原样：%1；起作用的是没有任何效应能解释的其他因素。</translation>
    </message>
    <message>
        <source>%1 = %2</source>
        <translation>%1 = %2</translation>
    </message>
    <message>
        <source>a curve over one covariate predicts far better, and beside it the effect must have something left to say</source>
        <translation>某一协变量上的曲线预测得好得多；在它旁边，该效应仍须有所解释</translation>
    </message>
    <message>
        <source>chance must not reach it, among all effects and shapes tried</source>
        <translation>在所有试过的效应和形状中，它不应是偶然能达到的</translation>
    </message>
    <message>
        <source>edges are found in intensities: where these are doubted, edges alone tell nothing</source>
        <translation>边缘由强度得出：强度可疑时，仅凭边缘说明不了什么</translation>
    </message>
    <message>
        <source>it must make the residuals of scenes held out smaller, or move the extrinsic</source>
        <translation>它须使留出场景的残差变小，或使外参移动</translation>
    </message>
    <message>
        <source>no device has an effect of such a size: it stands in for another</source>
        <translation>没有设备会有这么大的效应：它在替代别的效应</translation>
    </message>
    <message>
        <source>one scene with all the leverage must not decide for the others</source>
        <translation>不应由一个影响力过大的场景替其他场景决定</translation>
    </message>
    <message>
        <source>scenes held out must be predicted better by more than they differ among each other</source>
        <translation>留出场景的预测改进须大于它们彼此间的差异</translation>
    </message>
    <message>
        <source>something at one place predicts better, and the effect must take away half of it</source>
        <translation>某处的局部结构预测得更好，该效应须消去其中一半</translation>
    </message>
    <message>
        <source>the best of so many candidates gains something by chance alone</source>
        <translation>这么多候选中最好的一个仅凭偶然也会有所增益</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; the model takes that out of the images, so that the extrinsic is for a camera without it: calibrate the camera again, or use --intrinsics free</source>
        <translation>图像与内参矛盾：%1；模型已从图像中去除它，因此外参适用于没有它的相机：请重新标定相机，或使用 --intrinsics free</translation>
    </message>
    <message>
        <source>the intensity is not in every cloud, or the same on all points</source>
        <translation>并非每个点云都有强度，或所有点的强度相同</translation>
    </message>
    <message>
        <source>the laser line is not in every cloud, or there is one only</source>
        <translation>并非每个点云都有激光线号，或只有一条线</translation>
    </message>
    <message>
        <source>the time is not in every cloud</source>
        <translation>并非每个点云都有时间</translation>
    </message>
    <message>
        <source>tried in the model, it must not predict scenes held out worse or come to nothing</source>
        <translation>放入模型试用后，它不得使留出场景的预测变差，也不得化为乌有</translation>
    </message>
    <message>
        <source>what shows in one scene only may be that scene&apos;s own fault</source>
        <translation>只在一个场景中出现的可能是该场景自身的问题</translation>
    </message>
    <message>
        <source>where much is wrong, what explains a little of it stands in for something else</source>
        <translation>误差很大时，只解释其中一点的效应是在替代别的东西</translation>
    </message>
    <message>
        <source>white and black print must tell the same about an effect of either</source>
        <translation>对于任一印刷颜色上的效应，白色和黑色须给出相同的结论</translation>
    </message>
    <message>
        <source>tag corners miss their model by %1 px, where their own noise is %2 px: that may move the extrinsic by up to %3 mm and %4 mrad; check the intrinsics, the sizes in target.yaml and that the board is flat</source>
        <translation>标签角点偏离模型 %1 px，而其自身噪声为 %2 px：这最多可能使外参移动 %3 mm 和 %4 mrad；请检查内参、target.yaml 中的尺寸以及标定板是否平整</translation>
    </message>
    <message>
        <source>another image of this name is in %1 already</source>
        <translation>%1 中已有同名的另一幅图像</translation>
    </message>
    <message>
        <source>give it another name</source>
        <translation>请另取一个名称</translation>
    </message>
    <message>
        <source>not an image; expected a png, jpg, bmp or tiff file</source>
        <translation>不是图像；应为 png、jpg、bmp 或 tiff 文件</translation>
    </message>
    <message>
        <source>%1: an effect is missing in the model</source>
        <translation>%1：模型中缺少一个效应</translation>
    </message>
    <message>
        <source>%1: an effect is missing in the model; scene %2 misses most</source>
        <translation>%1：模型中缺少一个效应；场景 %2 偏差最大</translation>
    </message>
    <message>
        <source>%1: an effect is missing in the model; scene %2 misses most: %3 mm, the others %4 mm</source>
        <translation>%1：模型中缺少一个效应；场景 %2 偏差最大：%3 mm，其余为 %4 mm</translation>
    </message>
    <message>
        <source>%1; scene %2 misses most: %3 mm, the others %4 mm: did the board or a sensor move while it was taken, or is an effect missing in the model?</source>
        <translation>%1；场景 %2 偏差最大：%3 mm，其余为 %4 mm：拍摄该场景时标定板或传感器是否移动过，还是模型中缺少一个效应？</translation>
    </message>
    <message>
        <source>LiDAR residuals are %1 times (nodes) and %2 times (planes) their noise</source>
        <translation>激光雷达残差为其噪声的 %1 倍（节点）和 %2 倍（平面）</translation>
    </message>
    <message>
        <source>the boards&apos; planes miss the LiDAR&apos;s ranges by %1 times their noise</source>
        <translation>标定板平面与激光雷达测距之差为其噪声的 %1 倍</translation>
    </message>
    <message>
        <source>choose the folder that holds these, or make a dataset from a recording or from files</source>
        <translation>请选择包含这些内容的文件夹，或由录制数据或文件生成数据集</translation>
    </message>
    <message>
        <source>open it where it is now, or make a dataset from a recording or from files</source>
        <translation>请到其现在的位置打开，或由录制数据或文件生成数据集</translation>
    </message>
    <message>
        <source>A compressed cloud that unpacks to more is refused.</source>
        <translation>解压后大于此值的压缩点云会被拒绝。</translation>
    </message>
    <message>
        <source>max unpacked mib</source>
        <translation>解压上限 MiB</translation>
    </message>
    <message>
        <source>%1 bytes follow the last of the %2 points that its header counts, and are left out: are there more points, or two files in one?</source>
        <translation>文件头声明的 %2 个点中最后一点之后还有 %1 字节，未予采用：是点数更多，还是两个文件连在了一起？</translation>
    </message>
    <message>
        <source>LiDAR and camera cannot both be called &apos;%1&apos;: no reader could tell the frames apart</source>
        <translation>激光雷达和相机不能都叫“%1”：读取者无法区分这两个坐标系</translation>
    </message>
    <message>
        <source>from point %1 of %2 on none is a return (all are NaN, infinite or at the origin), as if the recording had been cut off</source>
        <translation>从第 %1 点起（共 %2 点）再无回波（全为 NaN、无穷大或位于原点），似乎录制被中断</translation>
    </message>
    <message>
        <source>give each frame a name of its own</source>
        <translation>请给每个坐标系各取一个名称</translation>
    </message>
    <message>
        <source>it is turned by a quarter: turn it back, and switch off what turns images, or use intrinsics of the turned ones</source>
        <translation>图像被转了 90°：请转回并关闭旋转图像的功能，或使用旋转后图像的内参</translation>
    </message>
    <message>
        <source>its compressed data unpack to %1 MiB, more than the limit of %2 MiB</source>
        <translation>其压缩数据解压后为 %1 MiB，超过 %2 MiB 的上限</translation>
    </message>
    <message>
        <source>its corners and its returns are those of scene %1, of which it is a copy that counts once</source>
        <translation>其角点和回波与场景 %1 相同，是该场景的副本，只计一次</translation>
    </message>
    <message>
        <source>its image is turned against those of the other scenes: all agree once it is turned counterclockwise by %1°; turn it, and switch off what turns images</source>
        <translation>其图像相对其他场景的图像转了方向：逆时针旋转 %1° 后所有场景一致；请旋转该图像，并关闭旋转图像的功能</translation>
    </message>
    <message>
        <source>keep the one that is meant</source>
        <translation>请只保留想要的那一个</translation>
    </message>
    <message>
        <source>key &apos;%1&apos; is there twice, first in line %2</source>
        <translation>键“%1”出现了两次，第一次在第 %2 行</translation>
    </message>
    <message>
        <source>overlap less, or choose a larger paper</source>
        <translation>请减小重叠，或选择更大的纸张</translation>
    </message>
    <message>
        <source>paper &apos;%1&apos; has no room for pages that share %2 mm with each neighbour; expected %3 mm at most</source>
        <translation>纸张“%1”容不下与每个相邻页重叠 %2 mm 的页面；最多应为 %3 mm</translation>
    </message>
    <message>
        <source>scene %1 has %2 and %3: %2 is used; delete the other</source>
        <translation>场景 %1 同时有 %2 和 %3：使用 %2；请删除另一个</translation>
    </message>
    <message>
        <source>scene %1: its cloud: %2</source>
        <translation>场景 %1：其点云：%2</translation>
    </message>
    <message>
        <source>the clouds&apos; intensity is left out, as you decided</source>
        <translation>按您的决定，不使用点云的强度</translation>
    </message>
    <message>
        <source>the clouds&apos; intensity is left out, as you decided: the extrinsic rests on planes and corners, and the print does not hold it sideways</source>
        <translation>按您的决定，不使用点云的强度：外参仅依据平面和角点，印刷图案无法约束其横向位置</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; turn them, and switch off what turns images, or calibrate the camera from images as they are</source>
        <translation>图像与内参矛盾：%1；请旋转这些图像并关闭旋转图像的功能，或用现有方向的图像标定相机</translation>
    </message>
    <message>
        <source>their circles are of another size: %1 would fit</source>
        <translation>图像中圆的大小不同：%1 才相符</translation>
    </message>
    <message>
        <source>they agree with them once they are turned counterclockwise by %1°</source>
        <translation>逆时针旋转 %1° 后两者一致</translation>
    </message>
    <message>
        <source>write the cloud with fewer points or uncompressed, or raise clouds.max_unpacked_mib in the options</source>
        <translation>请减少点数或以不压缩方式写出点云，或在选项中提高 clouds.max_unpacked_mib</translation>
    </message>
    <message>
        <source>the distortion model %1 predicts images held out to %2 px, %3 only to %4 px</source>
        <translation>畸变模型 %1 对未参与拟合的图像的预测误差为 %2 px，而 %3 为 %4 px</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; calibrate the camera again with it</source>
        <translation>图像与内参矛盾：%1；请用该模型重新标定相机</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; with it the extrinsic moves by %2 mm and %3 mrad, less than what matters</source>
        <translation>图像与内参矛盾：%1；采用该模型后外参移动 %2 mm 和 %3 mrad，小于有影响的程度</translation>
    </message>
    <message>
        <source>the images contradict the intrinsics: %1; with it the extrinsic moves by %2 mm and %3 mrad; calibrate the camera again with it</source>
        <translation>图像与内参矛盾：%1；采用该模型后外参移动 %2 mm 和 %3 mrad；请用该模型重新标定相机</translation>
    </message>
    <message>
        <source>the images of scenes %1 and those of scenes %2 are turned against each other: all agree once the former are turned counterclockwise by %3°, or the latter by %4°; nothing tells which are as the camera gives them: turn those that are not, and switch off what turns images</source>
        <translation>场景 %1 的图像与场景 %2 的图像方向互不一致：把前者逆时针旋转 %3°，或把后者逆时针旋转 %4° 后全部吻合；无法判断哪些是相机原本的方向：请旋转不是原本方向的图像，并关闭旋转图像的功能</translation>
    </message>
    <message>
        <source>circles cannot be measured in any scene (too few lines or points, or intensities in coarse steps): the prints as a whole, planes and corners are used instead</source>
        <translation>所有场景中都无法测量圆（线数或点数太少，或强度分级太粗）：改用整块图案、平面和角点</translation>
    </message>
    <message>
        <source>circles cannot be measured in scenes %1 (too few lines or points, or intensities in coarse steps): their prints as a whole, planes and corners are used instead</source>
        <translation>场景 %1 中无法测量圆（线数或点数太少，或强度分级太粗）：改用这些场景的整块图案、平面和角点</translation>
    </message>
    <message>
        <source>images and ranges together contradict the intrinsics: %1; with that freed the extrinsic moves by %2 mm and %3 mrad; calibrate the camera again, or use --intrinsics free, unless lvcalib discover finds an effect of the LiDAR</source>
        <translation>图像与测距合起来与内参矛盾：%1；放开这些内参后外参移动 %2 mm 和 %3 mrad；请重新标定相机，或使用 --intrinsics free，除非 lvcalib discover 找到激光雷达的某种效应</translation>
    </message>
    <message>
        <source>the joint solve has not come to rest after %1 steps</source>
        <translation>联合求解在 %1 步之后仍未收敛</translation>
    </message>
    <message>
        <source>the board is not found in the cloud: something stands where the other scenes put it, with too few lines or points to tell its print</source>
        <translation>点云中未找到标定板：在其他场景所指的位置上有物体，但其上的扫描线或点太少，无法辨认印刷图案</translation>
    </message>
    <message>
        <source>check camera.yaml, or calibrate the camera again</source>
        <translation>检查 camera.yaml，或重新标定相机</translation>
    </message>
    <message>
        <source>check camera.yaml: is it of this camera, and of images of this size?</source>
        <translation>检查 camera.yaml：它是这台相机的、对应这种图像尺寸的吗？</translation>
    </message>
    <message>
        <source>images and clouds together contradict the intrinsics: %1</source>
        <translation>图像与点云合在一起与内参矛盾：%1</translation>
    </message>
    <message>
        <source>the tag does not look in the image as it would with these intrinsics</source>
        <translation>图像中的标签与这些内参下应有的样子不符</translation>
    </message>
    <message>
        <source>the LiDAR&apos;s beams start beside the origin of its frame, by %1 mm; with that the extrinsic moves by %2 mm and %3 mrad: are the clouds in another frame, as a vehicle&apos;s? if not, find the effect with lvcalib discover</source>
        <translation>激光雷达的光束起点偏离其坐标原点 %1 mm；计入后外参移动 %2 mm 和 %3 mrad：点云是否在其他坐标系（如车体坐标系）中？若不是，请用 lvcalib discover 查找该效应</translation>
    </message>
    <message>
        <source>the board is not found in the cloud: no return lies on it where the other scenes put it</source>
        <translation>点云中找不到标定板：在其他场景给出的位置上没有任何回波</translation>
    </message>
    <message>
        <source>one usable scene; a target without circles needs three or more, differently turned</source>
        <translation>可用场景 1 个；没有圆的标定板需要三个或更多朝向不同的场景</translation>
    </message>
    <message>
        <source>sizes of users&apos; effects: expected 0 &lt; size of interest &lt; believable size</source>
        <translation>用户自定义效应的大小：应满足 0 &lt; 关注大小 &lt; 可信大小</translation>
    </message>
    <message>
        <source>scene %1 contradicts the others only without %2: it is used, with that in the model</source>
        <translation>场景 %1 只在没有 %2 时才与其他场景矛盾：已使用它，并将其纳入模型</translation>
    </message>
    <message>
        <source>%1, as if its coefficients were listed as %2</source>
        <translation>%1，好像其系数按 %2 的顺序列出</translation>
    </message>
    <message>
        <source>its corners miss the camera of the other images by %1 px RMS; was it taken in motion, or is it of another board or camera?</source>
        <translation>其角点与由其他图像得到的相机相差 %1 px RMS；是在运动中拍摄的，还是另一块标定板或另一台相机的图像？</translation>
    </message>
    <message>
        <source>points %1 to %2 of %3 are nothing but zero bytes, as if a part of the file had been lost</source>
        <translation>%3 个点中第 %1 至 %2 个全是零字节，文件似乎丢失了一部分</translation>
    </message>
    <message>
        <source>scenes %1 are not used: %2</source>
        <translation>场景 %1 未采用：%2</translation>
    </message>
    <message>
        <source>%1: the outer squares reach %2 mm beyond the board&apos;s outline; measure boardWidth, boardHeight and boardOffset</source>
        <translation>%1：外圈方格超出标定板外形 %2 mm；请测量 boardWidth、boardHeight 和 boardOffset</translation>
    </message>
    <message>
        <source>%1: the outer squares reach %2 mm beyond the board&apos;s outline; with targetCols: %3 and targetRows: %4 they would not</source>
        <translation>%1：外圈方格超出标定板外形 %2 mm；若 targetCols: %3、targetRows: %4 则不会</translation>
    </message>
    <message>
        <source>%1: without boardWidth and boardHeight the board is taken to end with its outer squares, and clouds are searched for one of that size; measure the board</source>
        <translation>%1：没有 boardWidth 和 boardHeight，便认为标定板到外圈方格为止，并在点云中查找这一大小的板；请测量标定板</translation>
    </message>
    <message>
        <source>if all of it is visible, targetCols: %1 and targetRows: %2 would fit</source>
        <translation>如果它全部可见，则 targetCols: %1、targetRows: %2 相符</translation>
    </message>
    <message>
        <source>no checkerboard with %1 × %2 inner corners in the image, but one with %3 × %4</source>
        <translation>图像中没有内角点为 %1 × %2 的棋盘格，但有 %3 × %4 的</translation>
    </message>
    <message>
        <source>with targetCols: %1 and targetRows: %2 it would not</source>
        <translation>若 targetCols: %1、targetRows: %2 则不会</translation>
    </message>
    <message>
        <source>tagId: %1 would fit; or use the right board</source>
        <translation>tagId: %1 相符；或使用正确的标定板</translation>
    </message>
    <message>
        <source>%1 To take it out anyway: --with %2</source>
        <translation>%1仍要去除它：--with %2</translation>
    </message>
    <message>
        <source>No effect of the catalogue explains what the %1 channel does over %2 (%3 % of its held-out variance, %4).</source>
        <translation>目录中没有效应能解释%1通道随 %2 的变化（占其留出方差的 %3 %，%4）。</translation>
    </message>
    <message>
        <source>tags of family %1 with a %2 found; the target is a checkerboard</source>
        <translation>找到的是标签族 %1、%2的标签；而标定板是棋盘格</translation>
    </message>
    <message>
        <source>markers of %1 found; the target is a checkerboard</source>
        <translation>找到的是 %1 的标记；而标定板是棋盘格</translation>
    </message>
    <message>
        <source>each intensity belongs to the point that stands %1 after it</source>
        <translation>每个强度都属于其后第 %1 个点</translation>
    </message>
    <message>
        <source>each intensity belongs to the point that stands %1 before it</source>
        <translation>每个强度都属于其前第 %1 个点</translation>
    </message>
    <message>
        <source>the board is not found in any cloud, but it is if %1</source>
        <translation>在任何点云中都找不到标定板；但若%1，则能找到</translation>
    </message>
    <message>
        <source>the clouds are %1</source>
        <translation>点云是%1的</translation>
    </message>
    <message>
        <source>the clouds are mirrored (their axes make a left-handed frame)</source>
        <translation>点云是镜像的（其坐标轴构成左手系）</translation>
    </message>
    <message>
        <source>the scenes do not agree, but %1 of them do if %2</source>
        <translation>各场景不一致；但若%2，则其中 %1 个一致</translation>
    </message>
    <message>
        <source>write every intensity with its own point</source>
        <translation>请把每个强度写在它自己的点上</translation>
    </message>
    <message>
        <source>write the clouds in metres</source>
        <translation>请以米为单位写出点云</translation>
    </message>
</context>
<context>
    <name>CoreWords</name>
    <message>
        <source>These totals are still the base model&apos;s: this model&apos;s follow once the effects that it may lack have been looked for.</source>
        <translation>目前的总计仍是基础模型的：查找完此模型可能缺少的效应后，才会给出此模型的总计。</translation>
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
    <message>
        <source>good so far; still looking for what is missing</source>
        <translation>目前良好；仍在查找遗漏的效应</translation>
    </message>
    <message>
        <source>good so far; nobody has looked for what is missing</source>
        <translation>目前良好；尚未查找遗漏的效应</translation>
    </message>
</context>
<context>
    <name>Decisions</name>
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
    <message>
        <source>add %1</source>
        <translation>添加 %1</translation>
    </message>
    <message>
        <source>use %1 all the same</source>
        <translation>仍然采用 %1</translation>
    </message>
    <message>
        <source>no longer use %1 all the same</source>
        <translation>不再强制采用 %1</translation>
    </message>
    <message>
        <source>choose measurements of %1</source>
        <translation>选择 %1 的测量</translation>
    </message>
    <message>
        <source>note on %1</source>
        <translation>为 %1 写备注</translation>
    </message>
    <message>
        <source>order scenes</source>
        <translation>排列场景</translation>
    </message>
    <message>
        <source>take a rough pose by hand</source>
        <translation>采用手动找到的粗略位姿</translation>
    </message>
    <message>
        <source>forget the rough pose</source>
        <translation>不再使用粗略位姿</translation>
    </message>
</context>
<context>
    <name>Docks</name>
    <message>
        <source>Detach or attach</source>
        <translation>分离或停靠</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>隐藏</translation>
    </message>
</context>
<context>
    <name>EditsText</name>
    <message numerus="yes">
        <source>%n points</source>
        <translation>
            <numerusform>%n 个点</numerusform>
        </translation>
    </message>
    <message>
        <source>Left out by hand: %1.</source>
        <translation>手动排除：%1。</translation>
    </message>
    <message>
        <source>Used all the same: %1.</source>
        <translation>仍然采用：%1。</translation>
    </message>
    <message>
        <source>Left out by the program: %1.</source>
        <translation>程序未采用：%1。</translation>
    </message>
    <message>
        <source>tag no. %1</source>
        <translation>标签（编号 %1）</translation>
    </message>
    <message>
        <source>circle no. %1</source>
        <translation>圆（编号 %1）</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message numerus="yes">
        <source>%n parts of the board</source>
        <translation>
            <numerusform>标定板的 %n 个部分</numerusform>
        </translation>
    </message>
    <message>
        <source>a part of the board</source>
        <translation>标定板的一个部分</translation>
    </message>
</context>
<context>
    <name>ModelText</name>
    <message>
        <source>range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>强度</translation>
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
    <message>
        <source>chance of something this large, after the search</source>
        <translation>搜索之后偶然出现这么大的概率</translation>
    </message>
    <message>
        <source>gain in scenes held out, standard errors</source>
        <translation>留出场景中的增益（标准误差）</translation>
    </message>
    <message>
        <source>gain, against what chance finds in a search</source>
        <translation>增益，与搜索中偶然所得相比</translation>
    </message>
    <message>
        <source>share of scenes predicted better</source>
        <translation>预测得更好的场景所占比例</translation>
    </message>
    <message>
        <source>scenes predicted better</source>
        <translation>预测得更好的场景数</translation>
    </message>
    <message>
        <source>distance from what devices have, σ²</source>
        <translation>与设备可能取值的距离（σ²）</translation>
    </message>
    <message>
        <source>share of what its channel misses by</source>
        <translation>占其通道失配的比例</translation>
    </message>
    <message>
        <source>fall of held-out squares, over the least asked</source>
        <translation>留出平方和的下降与最低要求之比</translation>
    </message>
    <message>
        <source>nothing else speaks against it</source>
        <translation>没有其他证据反对它</translation>
    </message>
    <message>
        <source>Why it is suggested</source>
        <translation>为何建议</translation>
    </message>
    <message>
        <source>Why it is not suggested</source>
        <translation>为何不建议</translation>
    </message>
    <message>
        <source>Left out, it may move the extrinsic by more than the tolerance: it matters.</source>
        <translation>若不考虑，它可能使外参移动超过容差：它有影响。</translation>
    </message>
    <message>
        <source>Left out, it moves the extrinsic by less than the tolerance.</source>
        <translation>若不考虑，它使外参的移动小于容差。</translation>
    </message>
    <message>
        <source>white and black print agree</source>
        <translation>白色与黑色印刷一致</translation>
    </message>
    <message>
        <source>edges can be trusted</source>
        <translation>边缘可信</translation>
    </message>
    <message>
        <source>it says something beside a curve</source>
        <translation>在曲线旁仍有所解释</translation>
    </message>
    <message>
        <source>it explains what sits at a place</source>
        <translation>能解释某处的局部结构</translation>
    </message>
    <message>
        <source>tried, it predicts no worse</source>
        <translation>试用后预测不变差</translation>
    </message>
    <message>
        <source>(%1: not possible)</source>
        <translation>（%1：无法实现）</translation>
    </message>
</context>
<context>
    <name>PlanText</name>
    <message>
        <source>upper left</source>
        <translation>左上</translation>
    </message>
    <message>
        <source>upper middle</source>
        <translation>中上</translation>
    </message>
    <message>
        <source>upper right</source>
        <translation>右上</translation>
    </message>
    <message>
        <source>left</source>
        <translation>左侧</translation>
    </message>
    <message>
        <source>in the middle</source>
        <translation>正中</translation>
    </message>
    <message>
        <source>right</source>
        <translation>右侧</translation>
    </message>
    <message>
        <source>lower left</source>
        <translation>左下</translation>
    </message>
    <message>
        <source>lower middle</source>
        <translation>中下</translation>
    </message>
    <message>
        <source>lower right</source>
        <translation>右下</translation>
    </message>
    <message>
        <source>%1 m ahead</source>
        <translation>前方 %1 m</translation>
    </message>
    <message>
        <source>facing the camera</source>
        <translation>正对相机</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>upper side %1° nearer</source>
        <translation>上边前倾 %1°</translation>
    </message>
    <message>
        <source>upper side %1° back</source>
        <translation>上边后仰 %1°</translation>
    </message>
    <message>
        <source>right side %1° back</source>
        <translation>右边后转 %1°</translation>
    </message>
    <message>
        <source>left side %1° back</source>
        <translation>左边后转 %1°</translation>
    </message>
    <message>
        <source>rolled %1° left</source>
        <translation>左旋 %1°</translation>
    </message>
    <message>
        <source>rolled %1° right</source>
        <translation>右旋 %1°</translation>
    </message>
    <message>
        <source>Six-line rosette</source>
        <translation>六线花瓣扫描</translation>
    </message>
    <message>
        <source>Spinning, 128 lines</source>
        <translation>旋转式，128 线</translation>
    </message>
</context>
<context>
    <name>QPlatformTheme</name>
    <message>
        <source>OK</source>
        <translation>确定</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>不保存</translation>
    </message>
    <message>
        <source>&amp;Yes</source>
        <translation>是(&amp;Y)</translation>
    </message>
    <message>
        <source>&amp;No</source>
        <translation>否(&amp;N)</translation>
    </message>
</context>
<context>
    <name>RunStory</name>
    <message>
        <source>first run, or asked for</source>
        <translation>首次运行，或应要求运行</translation>
    </message>
    <message>
        <source>the scenes in use or options of the solve changed</source>
        <translation>所用场景或求解选项已改变</translation>
    </message>
    <message>
        <source>options changed</source>
        <translation>选项已改变</translation>
    </message>
    <message>
        <source>scenes were added or removed</source>
        <translation>场景有增减</translation>
    </message>
    <message>
        <source>the scenes in use changed</source>
        <translation>所用场景已改变</translation>
    </message>
    <message>
        <source>crops changed</source>
        <translation>裁剪已改变</translation>
    </message>
    <message>
        <source>what is left out by hand changed</source>
        <translation>手动排除的内容已改变</translation>
    </message>
    <message>
        <source>the rough extrinsic changed</source>
        <translation>粗略外参已改变</translation>
    </message>
    <message>
        <source>it was asked for, or files changed</source>
        <translation>应要求运行，或文件已改变</translation>
    </message>
    <message>
        <source>images</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>search in the clouds</source>
        <translation>点云搜索</translation>
    </message>
    <message>
        <source>refinement</source>
        <translation>精化</translation>
    </message>
    <message>
        <source>%1 %2 s</source>
        <translation>%1 %2 s</translation>
    </message>
    <message>
        <source>joint solve</source>
        <translation>联合求解</translation>
    </message>
    <message>
        <source>Ran (%1): %2.</source>
        <translation>已运行（%1）：%2。</translation>
    </message>
    <message>
        <source>Kept: %1.</source>
        <translation>沿用：%1。</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets</name>
    <message>
        <source>Quality:</source>
        <translation>质量：</translation>
    </message>
    <message>
        <source>%1 scenes, %2 px (corners), %3 mm (LiDAR)</source>
        <translation>%1 个场景，%2 px（角点），%3 mm（激光雷达）</translation>
    </message>
    <message>
        <source>roll</source>
        <translation>横滚</translation>
    </message>
    <message>
        <source>pitch</source>
        <translation>俯仰</translation>
    </message>
    <message>
        <source>yaw</source>
        <translation>偏航</translation>
    </message>
    <message>
        <source>unbounded</source>
        <translation>无界</translation>
    </message>
    <message>
        <source>Translation (LiDAR origin in the camera frame)</source>
        <translation>平移（激光雷达原点在相机坐标系中）</translation>
    </message>
    <message>
        <source>Roll, pitch, yaw (R = Rz·Ry·Rx)</source>
        <translation>横滚、俯仰、偏航 (R = Rz·Ry·Rx)</translation>
    </message>
    <message>
        <source>T_camera_lidar</source>
        <translation>T_camera_lidar</translation>
    </message>
    <message>
        <source>Quaternion x y z w</source>
        <translation>四元数 x y z w</translation>
    </message>
    <message>
        <source>Standard deviations along the camera&apos;s axes</source>
        <translation>沿相机各轴的标准差</translation>
    </message>
    <message>
        <source>Weak directions</source>
        <translation>弱方向</translation>
    </message>
    <message>
        <source>None: the scenes determine all six.</source>
        <translation>无：这些场景确定了全部六个方向。</translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation>警告</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>mean pitch (°)</source>
        <translation>俯仰均值 (°)</translation>
    </message>
    <message>
        <source>mean yaw (°)</source>
        <translation>偏航均值 (°)</translation>
    </message>
    <message>
        <source>mean range (mm)</source>
        <translation>距离均值 (mm)</translation>
    </message>
    <message>
        <source>σ pitch (°)</source>
        <translation>俯仰 σ (°)</translation>
    </message>
    <message>
        <source>σ yaw (°)</source>
        <translation>偏航 σ (°)</translation>
    </message>
    <message>
        <source>σ range (mm)</source>
        <translation>距离 σ (mm)</translation>
    </message>
    <message>
        <source>δ (mm)</source>
        <translation>δ (mm)</translation>
    </message>
    <message>
        <source>σ transition (mm)</source>
        <translation>过渡 σ (mm)</translation>
    </message>
    <message>
        <source>Mean of the residuals to the nearest ideal boundary points</source>
        <translation>到最近理想边界点的残差均值</translation>
    </message>
    <message>
        <source>Standard deviation of a beam on the edge</source>
        <translation>边缘上光束的标准差</translation>
    </message>
    <message>
        <source>Samples of the overlap region</source>
        <translation>重叠区的样本数</translation>
    </message>
    <message>
        <source>Where the intensity is half way, from the circle&apos;s edge, outside positive</source>
        <translation>强度居中处到圆边缘的距离，向外为正</translation>
    </message>
    <message>
        <source>Width of the error function on the board</source>
        <translation>误差函数在标定板上的宽度</translation>
    </message>
    <message>
        <source>Numbers are given ± their own standard deviation.</source>
        <translation>数值后的 ± 为其自身的标准差。</translation>
    </message>
    <message>
        <source>no statistics</source>
        <translation>无统计</translation>
    </message>
    <message>
        <source>%1 mm, %2 mrad</source>
        <translation>%1 mm，%2 mrad</translation>
    </message>
    <message>
        <source>Halves</source>
        <translation>两半</translation>
    </message>
    <message>
        <source>scenes</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>difference</source>
        <translation>差异</translation>
    </message>
    <message>
        <source>by noise alone</source>
        <translation>仅由噪声引起</translation>
    </message>
    <message>
        <source>χ² (limit)</source>
        <translation>χ²（上限）</translation>
    </message>
    <message>
        <source>agree</source>
        <translation>一致</translation>
    </message>
    <message>
        <source>disagree</source>
        <translation>不一致</translation>
    </message>
    <message>
        <source>Not enough scenes: three are needed.</source>
        <translation>场景不足：需要三个。</translation>
    </message>
    <message>
        <source>Without</source>
        <translation>去掉</translation>
    </message>
    <message>
        <source>moves and turns by</source>
        <translation>移动与转动</translation>
    </message>
    <message>
        <source>Range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>across the ray</source>
        <translation>垂直于光线</translation>
    </message>
    <message>
        <source>along it</source>
        <translation>沿光线</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>Halves of the scenes against each other</source>
        <translation>两半场景相互比较</translation>
    </message>
    <message>
        <source>Leaving one scene out</source>
        <translation>留一法</translation>
    </message>
    <message>
        <source>In the camera&apos;s view, one standard deviation</source>
        <translation>相机视野中的一倍标准差</translation>
    </message>
    <message>
        <source>in total</source>
        <translation>总计</translation>
    </message>
    <message>
        <source>Model:</source>
        <translation>模型：</translation>
    </message>
    <message>
        <source>statistical</source>
        <translation>统计</translation>
    </message>
    <message>
        <source>Statistical: what the noise of these scenes leaves open.</source>
        <translation>统计：这些场景的噪声所留下的不确定。</translation>
    </message>
    <message>
        <source>across, total</source>
        <translation>垂直于光线，总计</translation>
    </message>
    <message>
        <source>along, total</source>
        <translation>沿光线，总计</translation>
    </message>
    <message>
        <source>A LiDAR point at %1 m falls into the image with a standard deviation of %2 px where it is best to %3 px where it is worst, by noise alone.</source>
        <translation>%1 m 处的激光点投影到图像上的标准差（仅由噪声引起）：最好处 %2 px，最差处 %3 px。</translation>
    </message>
    <message>
        <source>In total: %1 px to %2 px.</source>
        <translation>总计：%1 px 至 %2 px。</translation>
    </message>
    <message>
        <source>given</source>
        <translation>给定</translation>
    </message>
    <message>
        <source>with the LiDAR</source>
        <translation>与激光雷达一同估计</translation>
    </message>
    <message>
        <source>images alone</source>
        <translation>仅由图像</translation>
    </message>
    <message>
        <source>No board reached these parts of the image: %1. The distortion there is extrapolated.</source>
        <translation>标定板没有到达图像的这些部分：%1。那里的畸变是外推的。</translation>
    </message>
    <message>
        <source>A direction falls into the image with a standard deviation of %1 px where it is best to %2 px where it is worst.</source>
        <translation>一个方向落在图像中的标准差：最好处为 %1 px，最差处为 %2 px。</translation>
    </message>
    <message>
        <source>The intrinsics are taken as given; the scenes check them.</source>
        <translation>内参按给定值使用，并由各场景检验。</translation>
    </message>
    <message>
        <source>The intrinsics are estimated with the extrinsic, and drawn to the given ones as the standard deviations in camera.yaml say.</source>
        <translation>内参与外参一同估计，并按 camera.yaml 中的标准差向给定值约束。</translation>
    </message>
    <message>
        <source>The intrinsics are estimated with the extrinsic, and drawn to the given ones as an ordinary calibration deserves.</source>
        <translation>内参与外参一同估计，并按一般标定应有的精度向给定值约束。</translation>
    </message>
    <message>
        <source>The intrinsics are estimated with the extrinsic, by these images alone.</source>
        <translation>内参与外参一同估计，仅依据这些图像。</translation>
    </message>
    <message>
        <source>model</source>
        <translation>模型</translation>
    </message>
    <message>
        <source>fx, px</source>
        <translation>fx，px</translation>
    </message>
    <message>
        <source>fy, px</source>
        <translation>fy，px</translation>
    </message>
    <message>
        <source>cx, px</source>
        <translation>cx，px</translation>
    </message>
    <message>
        <source>cy, px</source>
        <translation>cy，px</translation>
    </message>
    <message>
        <source>The images contradict the given intrinsics: %1.</source>
        <translation>图像与给定的内参矛盾：%1。</translation>
    </message>
    <message>
        <source>With that freed the extrinsic moves by %1.</source>
        <translation>将其放开后，外参移动 %1。</translation>
    </message>
    <message>
        <source>The images contradict target.yaml: %1.</source>
        <translation>图像与 target.yaml 矛盾：%1。</translation>
    </message>
    <message>
        <source>%1 of %2 images, %3 px RMS; noise of a corner %4 px.</source>
        <translation>%2 幅图像中的 %1 幅，RMS %3 px；角点噪声 %4 px。</translation>
    </message>
    <message>
        <source>Distortion models by the images that they were not fitted to: %1.</source>
        <translation>各畸变模型在未参与拟合的图像上的误差：%1。</translation>
    </message>
    <message>
        <source>With it the extrinsic moves by %1.</source>
        <translation>采用该模型后外参移动 %1。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::AboutDialog</name>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>LV-Calib Workbench %1

LiDAR–camera calibration with a printed board.
GPL-3.0-or-later (core library: BSD-3-Clause)</source>
        <translation>LV-Calib 工作台 %1

用打印标定板标定激光雷达与相机。
GPL-3.0-or-later（核心库：BSD-3-Clause）</translation>
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
    <name>lvcalib::widgets::AngleDistancePlot</name>
    <message>
        <source>polar angle ψ (°)</source>
        <translation>极角 ψ (°)</translation>
    </message>
    <message>
        <source>distance from the circle (mm)</source>
        <translation>到圆的距离 (mm)</translation>
    </message>
    <message>
        <source>dark sample</source>
        <translation>暗样本</translation>
    </message>
    <message>
        <source>bright sample</source>
        <translation>亮样本</translation>
    </message>
    <message>
        <source>edge in a bin, ±1σ</source>
        <translation>各区间的边缘，±1σ</translation>
    </message>
    <message>
        <source>fitted wave</source>
        <translation>拟合波形</translation>
    </message>
    <message>
        <source>Signed distance from the circle (mm, outside positive) against the polar angle (degrees). Dots: LiDAR samples coloured by intensity. Marks: where the intensity crosses its middle level in each angular bin, ±1σ. Line: the fitted wave Δcu·cos ψ + Δcv·sin ψ + Δr. Shaded: refused bins; violet and hatched: bins left out by hand.</source>
        <translation>到圆的有符号距离（mm，向外为正）与极角（度）的关系。点：按强度着色的激光样本。标记：各角度区间内强度穿过中间值处，±1σ。曲线：拟合的波形 Δcu·cos ψ + Δcv·sin ψ + Δr。阴影：被拒绝的区间；紫色斜线：手动剔除的区间。</translation>
    </message>
    <message>
        <source>left out by hand</source>
        <translation>手动剔除</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::AnglePlot</name>
    <message>
        <source>yaw (°)</source>
        <translation>偏航 (°)</translation>
    </message>
    <message>
        <source>pitch (°)</source>
        <translation>俯仰 (°)</translation>
    </message>
    <message>
        <source>Angles from each sample of the overlap region (of many, some) to the nearest point of the recovered circle. Solid: ellipses of one and two standard deviations of a beam on the edge. Dashed: one standard deviation of the dots themselves.</source>
        <translation>重叠区各样本（过多时取一部分）到所求圆上最近点的角度。实线：边缘上光束的一倍和两倍标准差椭圆。虚线：这些点自身的一倍标准差。</translation>
    </message>
    <message>
        <source>σ pitch %1°
σ yaw %2°</source>
        <translation>俯仰 σ %1°
偏航 σ %2°</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>样本</translation>
    </message>
    <message>
        <source>1σ, 2σ of a beam</source>
        <translation>光束的 1σ、2σ</translation>
    </message>
    <message>
        <source>1σ of the samples</source>
        <translation>样本的 1σ</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BarPlot</name>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoardChoice</name>
    <message>
        <source>The printed board; stretches whose image does not show it are left out</source>
        <translation>打印的标定板；图像中没有它的时段将被略去</translation>
    </message>
    <message>
        <source>target.yaml beside the recording</source>
        <translation>记录旁的 target.yaml</translation>
    </message>
    <message>
        <source>Standard board: 4 × 4 tags with circles</source>
        <translation>标准标定板：4 × 4 标签，带圆</translation>
    </message>
    <message>
        <source>Board of %1</source>
        <translation>%1 的标定板</translation>
    </message>
    <message>
        <source>Choose a target.yaml…</source>
        <translation>选择 target.yaml…</translation>
    </message>
    <message>
        <source>Make a target.yaml…</source>
        <translation>新建 target.yaml…</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoardFigure</name>
    <message>
        <source>board x (mm)</source>
        <translation>标定板 x (mm)</translation>
    </message>
    <message>
        <source>board y (mm)</source>
        <translation>标定板 y (mm)</translation>
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
    <message>
        <source>darker than predicted</source>
        <translation>比预测暗</translation>
    </message>
    <message>
        <source>brighter</source>
        <translation>比预测亮</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoardMapPlot</name>
    <message>
        <source>The board from the front. Lines: how each circle&apos;s centre moved from the first to the last iteration, enlarged. Ellipse: twice the standard deviation of the refined centre, enlarged alike. Cross: where the model has it.</source>
        <translation>标定板正面。线：各圆心从首次到末次迭代的移动（放大）。椭圆：精化圆心的两倍标准差（同样放大）。十字：模型中的位置。</translation>
    </message>
    <message>
        <source>no circles</source>
        <translation>没有圆</translation>
    </message>
    <message>
        <source>paths ×%1</source>
        <translation>路径 ×%1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BoxPlot</name>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::BudgetPlot</name>
    <message>
        <source>The history of the error appears here.</source>
        <translation>误差的历史显示在这里。</translation>
    </message>
    <message>
        <source>Step %1, %2: %3
RMS %4, noise %5, unexplained %6, held out %7 (%8)</source>
        <translation>第 %1 步，%2：%3
均方根 %4，噪声 %5，未解释 %6，留出 %7（%8）</translation>
    </message>
    <message>
        <source>error beyond noise</source>
        <translation>噪声以上的误差</translation>
    </message>
    <message>
        <source>%1 (noise %2)</source>
        <translation>%1（噪声 %2）</translation>
    </message>
    <message>
        <source>&lt; %1</source>
        <translation>&lt; %1</translation>
    </message>
    <message>
        <source>Error beyond the noise, every channel on its own scale: red unexplained, green explained by effects, grey what noise alone may leave; diamonds: scenes held out. Click to go to a step.</source>
        <translation>噪声以上的误差，每个通道用各自的比例：红色为未解释部分，绿色为效应已解释部分，灰色为仅由噪声也可能留下的部分；菱形：留出的场景。点击可转到某一步。</translation>
    </message>
    <message>
        <source>distance to the truth</source>
        <translation>与真值的距离</translation>
    </message>
    <message>
        <source>Step %1, %2: %3 mm (left bar) and %4 mrad (right bar) from the truth</source>
        <translation>第 %1 步，%2：与真值相差 %3 mm（左柱）和 %4 mrad（右柱）</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CameraDialog</name>
    <message>
        <source>Written: %1</source>
        <translation>已写入：%1</translation>
    </message>
    <message numerus="yes">
        <source>%n images.</source>
        <translation>
            <numerusform>%n 幅图像。</numerusform>
        </translation>
    </message>
    <message>
        <source>A camera from images of the board</source>
        <translation>由标定板图像标定相机</translation>
    </message>
    <message>
        <source>&amp;Images</source>
        <translation>图像(&amp;I)</translation>
    </message>
    <message>
        <source>&amp;Board</source>
        <translation>标定板(&amp;B)</translation>
    </message>
    <message>
        <source>Distortion &amp;model</source>
        <translation>畸变模型(&amp;M)</translation>
    </message>
    <message>
        <source>A folder of images of the board, or a dataset</source>
        <translation>标定板图像文件夹，或数据集</translation>
    </message>
    <message>
        <source>target.yaml in that folder</source>
        <translation>该文件夹中的 target.yaml</translation>
    </message>
    <message>
        <source>&amp;Folder…</source>
        <translation>文件夹(&amp;F)…</translation>
    </message>
    <message>
        <source>&amp;target.yaml…</source>
        <translation>target.yaml(&amp;T)…</translation>
    </message>
    <message>
        <source>the one that predicts held-out images best</source>
        <translation>对未参与拟合的图像预测最好的模型</translation>
    </message>
    <message>
        <source>&amp;Start from</source>
        <translation>起始相机(&amp;S)</translation>
    </message>
    <message>
        <source>Nothing: all is found from the images</source>
        <translation>无：全部由图像求得</translation>
    </message>
    <message>
        <source>A camera.yaml that is about right, for images in which few corners are seen</source>
        <translation>大致正确的 camera.yaml，用于只看得到少量角点的图像</translation>
    </message>
    <message>
        <source>&amp;camera.yaml…</source>
        <translation>camera.yaml(&amp;C)…</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CameraForm</name>
    <message>
        <source>a number is expected here</source>
        <translation>此处应为数字</translation>
    </message>
    <message>
        <source>Field of view: %1° × %2°</source>
        <translation>视场：%1° × %2°</translation>
    </message>
    <message>
        <source>&amp;Distortion:</source>
        <translation>畸变(&amp;D)：</translation>
    </message>
    <message>
        <source>plumb_bob: radial and tangential</source>
        <translation>plumb_bob：径向和切向</translation>
    </message>
    <message>
        <source>rational_polynomial: wide angles</source>
        <translation>rational_polynomial：广角</translation>
    </message>
    <message>
        <source>equidistant: fisheye</source>
        <translation>equidistant：鱼眼</translation>
    </message>
    <message>
        <source>What the lens makes of straight lines</source>
        <translation>镜头把直线变成的样子</translation>
    </message>
    <message>
        <source>Image width</source>
        <translation>图像宽度</translation>
    </message>
    <message>
        <source>Of the images as they are given to the calibration</source>
        <translation>指提供给标定的图像</translation>
    </message>
    <message>
        <source>Image height</source>
        <translation>图像高度</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>May stay blank</source>
        <translation>可以留空</translation>
    </message>
    <message>
        <source>Focal length, horizontal</source>
        <translation>水平焦距</translation>
    </message>
    <message>
        <source>In pixels; behind ± its standard deviation, blank: not stated</source>
        <translation>以像素为单位；± 之后为其标准差，留空表示未给出</translation>
    </message>
    <message>
        <source>Focal length, vertical</source>
        <translation>垂直焦距</translation>
    </message>
    <message>
        <source>Principal point, right</source>
        <translation>主点，向右</translation>
    </message>
    <message>
        <source>From the centre of the top left pixel; behind ± its standard deviation</source>
        <translation>从左上角像素的中心算起；± 之后为其标准差</translation>
    </message>
    <message>
        <source>Principal point, down</source>
        <translation>主点，向下</translation>
    </message>
    <message>
        <source>Radial %1</source>
        <translation>径向 %1</translation>
    </message>
    <message>
        <source>A coefficient of the distortion</source>
        <translation>畸变系数</translation>
    </message>
    <message>
        <source>Tangential %1</source>
        <translation>切向 %1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CameraPage</name>
    <message>
        <source>YAML (*.yaml *.yml)</source>
        <translation>YAML (*.yaml *.yml)</translation>
    </message>
    <message>
        <source>The image is being loaded …</source>
        <translation>正在加载图像 …</translation>
    </message>
    <message>
        <source>There is no image: %1</source>
        <translation>没有图像：%1</translation>
    </message>
    <message>
        <source>&amp;Shown</source>
        <translation>显示(&amp;S)</translation>
    </message>
    <message>
        <source>camera of this calibration</source>
        <translation>本次标定的相机</translation>
    </message>
    <message>
        <source>camera from images alone</source>
        <translation>仅由图像标定的相机</translation>
    </message>
    <message>
        <source>&amp;Add images…</source>
        <translation>添加图像(&amp;A)…</translation>
    </message>
    <message>
        <source>Images of the board without a cloud: they are copied into the dataset&apos;s folder intrinsics/ and count for the camera alone</source>
        <translation>没有点云的标定板图像：复制到数据集的 intrinsics/ 文件夹，只用于相机</translation>
    </message>
    <message>
        <source>&amp;Calibrate the camera</source>
        <translation>标定相机(&amp;C)</translation>
    </message>
    <message>
        <source>From all images of the board, without the LiDAR and without the given intrinsics</source>
        <translation>由标定板的全部图像，不用激光雷达，也不用给定的内参</translation>
    </message>
    <message>
        <source>Sa&amp;ve camera.yaml…</source>
        <translation>保存 camera.yaml(&amp;V)…</translation>
    </message>
    <message>
        <source>The camera shown, with its standard deviations</source>
        <translation>所显示的相机及其标准差</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>corners</source>
        <translation>角点</translation>
    </message>
    <message>
        <source>RMS, px</source>
        <translation>RMS，px</translation>
    </message>
    <message>
        <source>not used because</source>
        <translation>未使用的原因</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>不确定度</translation>
    </message>
    <message>
        <source>Intrinsics</source>
        <translation>内参</translation>
    </message>
    <message>
        <source>Images of the board</source>
        <translation>标定板图像</translation>
    </message>
    <message>
        <source>Scene %1: %2</source>
        <translation>场景 %1：%2</translation>
    </message>
    <message>
        <source>Exclude their tags (%1)</source>
        <translation>排除其标签（%1）</translation>
    </message>
    <message>
        <source>Leave out the tags of the corners selected, and solve again</source>
        <translation>排除所选角点的标签，并重新求解</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a rectangle over corners in the residuals: their tags can be left out of their scenes</source>
        <translation>在残差图中的角点上画一个矩形：可在各自的场景中排除这些角点的标签</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CheckDialog</name>
    <message>
        <source>The image is being loaded …</source>
        <translation>正在读取图像……</translation>
    </message>
    <message>
        <source>There is no image: %1</source>
        <translation>没有图像：%1</translation>
    </message>
    <message>
        <source>No edges in the picture</source>
        <translation>画面中没有边缘</translation>
    </message>
    <message>
        <source>Edge agreement %1 ± %2</source>
        <translation>边缘吻合度 %1 ± %2</translation>
    </message>
    <message>
        <source>Edges agree with the calibration, to %1 ± %2 px. A turn by %3, %4 or %5 mrad about the camera&apos;s x, y, z would have been noticed.</source>
        <translation>边缘与标定结果相符，相差 %1 ± %2 px。绕相机 x、y、z 轴转动 %3、%4 或 %5 mrad 就会被发现。</translation>
    </message>
    <message>
        <source>Edges contradict the calibration: they agree better after a turn by %1 mrad and a shift by %2 mm, and are %3 ± %4 px off.</source>
        <translation>边缘与标定结果矛盾：转动 %1 mrad、平移 %2 mm 后更吻合，现在相差 %3 ± %4 px。</translation>
    </message>
    <message>
        <source>Cannot tell: edges of LiDAR and image meet no better than by chance, here and nearby. The pose is wrong by more than what is searched, or the two do not show the same. Move it by hand until they meet.</source>
        <translation>无法判断：激光雷达与图像的边缘在此处及附近的吻合并不好于巧合。位姿误差超出了搜索范围，或者两者拍的不是同一处。请手动移动，直到边缘重合。</translation>
    </message>
    <message>
        <source>Cannot tell: where the edges agree is known to %1 px only. Take a place with more edges, near and far and all over the picture.</source>
        <translation>无法判断：边缘吻合的位置只能确定到 %1 px。请选边缘更多、远近都有、布满画面的地方。</translation>
    </message>
    <message>
        <source>Cannot tell: %1 edges of the LiDAR are in %2 parts of the picture; %3 in %4 are needed.</source>
        <translation>无法判断：激光雷达有 %1 条边缘落在画面的 %2 个区域中；至少需要 %4 个区域中的 %3 条。</translation>
    </message>
    <message>
        <source>Edges are being compared …</source>
        <translation>正在比较边缘……</translation>
    </message>
    <message>
        <source>Being read …</source>
        <translation>正在读取……</translation>
    </message>
    <message>
        <source>Choose a folder of images and clouds that were taken together, with or without a board.</source>
        <translation>请选择一个文件夹，其中是同时采集的图像和点云，有无标定板均可。</translation>
    </message>
    <message>
        <source>There is no pose yet: drag the points until they lie on what they show.</source>
        <translation>还没有位姿：请拖动点，直到它们落在所对应的物体上。</translation>
    </message>
    <message>
        <source>Moved by hand. Back to the start to have it judged.</source>
        <translation>已手动移动。回到起点即可重新判断。</translation>
    </message>
    <message numerus="yes">
        <source>%n pairs were left out; the first: %1</source>
        <translation>
            <numerusform>跳过了 %n 对；第一对：%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Check on fresh data</source>
        <translation>用新数据检验</translation>
    </message>
    <message>
        <source>&amp;Place</source>
        <translation>地点(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Folder…</source>
        <translation>文件夹(&amp;F)…</translation>
    </message>
    <message>
        <source>A folder of images and clouds that were taken together, or a dataset</source>
        <translation>同时采集的图像和点云所在的文件夹，或一个数据集</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点</translation>
    </message>
    <message>
        <source>The LiDAR&apos;s points under this pose, coloured by distance</source>
        <translation>此位姿下的激光雷达点，按距离着色</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>边缘</translation>
    </message>
    <message>
        <source>The LiDAR&apos;s edges: green where they lie on one of the image, red where not</source>
        <translation>激光雷达的边缘：与图像边缘重合的为绿色，不重合的为红色</translation>
    </message>
    <message>
        <source>The share of the LiDAR&apos;s edges that lie on one of the image, above what chance gives: 0 chance, 1 all. Of all places together.</source>
        <translation>激光雷达边缘中与图像边缘重合的比例，已扣除巧合：0 为巧合，1 为全部。所有地点合计。</translation>
    </message>
    <message>
        <source>Against the calibration</source>
        <translation>相对于标定结果</translation>
    </message>
    <message>
        <source>Against the rough pose</source>
        <translation>相对于粗略位姿</translation>
    </message>
    <message>
        <source>Against a LiDAR that looks ahead</source>
        <translation>相对于朝前安装的激光雷达</translation>
    </message>
    <message>
        <source>&amp;Range</source>
        <translation>范围(&amp;R)</translation>
    </message>
    <message>
        <source>fine: 50 mrad, 100 mm</source>
        <translation>精细：50 mrad，100 mm</translation>
    </message>
    <message>
        <source>coarse: 180°, 2 m</source>
        <translation>粗略：180°，2 m</translation>
    </message>
    <message>
        <source>Turn x, mrad</source>
        <translation>绕 x 转动，mrad</translation>
    </message>
    <message>
        <source>Turn y, mrad</source>
        <translation>绕 y 转动，mrad</translation>
    </message>
    <message>
        <source>Turn z, mrad</source>
        <translation>绕 z 转动，mrad</translation>
    </message>
    <message>
        <source>Shift x, mm</source>
        <translation>沿 x 平移，mm</translation>
    </message>
    <message>
        <source>Shift y, mm</source>
        <translation>沿 y 平移，mm</translation>
    </message>
    <message>
        <source>Shift z, mm</source>
        <translation>沿 z 平移，mm</translation>
    </message>
    <message>
        <source>About an axis of the camera: x right, y down, z ahead</source>
        <translation>绕相机的轴：x 向右，y 向下，z 向前</translation>
    </message>
    <message>
        <source>Along an axis of the camera: x right, y down, z ahead</source>
        <translation>沿相机的轴：x 向右，y 向下，z 向前</translation>
    </message>
    <message>
        <source>To where edges &amp;agree</source>
        <translation>移到边缘吻合处(&amp;A)</translation>
    </message>
    <message>
        <source>From this pose to the one nearby where most edges agree</source>
        <translation>从此位姿移到附近边缘最吻合的位姿</translation>
    </message>
    <message>
        <source>&amp;Back to the start</source>
        <translation>回到起点(&amp;B)</translation>
    </message>
    <message>
        <source>Take as &amp;rough pose</source>
        <translation>作为粗略位姿(&amp;R)</translation>
    </message>
    <message>
        <source>The board is then looked for about where this pose has it; can be undone</source>
        <translation>随后在此位姿所指的附近寻找标定板；可撤销</translation>
    </message>
    <message>
        <source>&amp;No rough pose</source>
        <translation>不用粗略位姿(&amp;N)</translation>
    </message>
    <message>
        <source>Drag in the picture: the points follow. With Shift they turn about the middle, with Ctrl they shift. The wheel zooms.</source>
        <translation>在画面中拖动，点会跟随。按住 Shift 绕画面中心转动，按住 Ctrl 平移。滚轮缩放。</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>Points:</source>
        <translation>点：</translation>
    </message>
    <message>
        <source>Edges:</source>
        <translation>边缘：</translation>
    </message>
    <message>
        <source>on an edge of the image</source>
        <translation>与图像边缘重合</translation>
    </message>
    <message>
        <source>on none</source>
        <translation>不重合</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudBrush</name>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a line about points to select them, at whatever depth. With Shift they are added to those selected</source>
        <translation>圈住要选中的点，不论远近。按住 Shift 则加入已选中的点</translation>
    </message>
    <message>
        <source>Exclude these</source>
        <translation>排除所选</translation>
    </message>
    <message>
        <source>Leave out what is selected, in every scene, and solve again</source>
        <translation>在所有场景中排除所选内容并重新求解</translation>
    </message>
    <message>
        <source>none about a board</source>
        <translation>都不在标定板附近</translation>
    </message>
    <message numerus="yes">
        <source>%n points</source>
        <translation>
            <numerusform>%n 个点</numerusform>
        </translation>
    </message>
    <message>
        <source>Only points about a board play a part.</source>
        <translation>只有标定板附近的点参与求解。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudPane</name>
    <message>
        <source>Cloud</source>
        <translation>点云</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>高度</translation>
    </message>
    <message>
        <source>Range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>Camera colour</source>
        <translation>相机颜色</translation>
    </message>
    <message>
        <source>Colour of the points</source>
        <translation>点的颜色</translation>
    </message>
    <message>
        <source>All points</source>
        <translation>全部点</translation>
    </message>
    <message>
        <source>Crop</source>
        <translation>裁剪框内</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>Boundary samples</source>
        <translation>边界样本</translation>
    </message>
    <message>
        <source>Which points are shown: all, those in the crop box, those about the board, or those beside the circles&apos; edges</source>
        <translation>显示哪些点：全部、裁剪框内、标定板附近或圆边缘附近</translation>
    </message>
    <message>
        <source>Points shown</source>
        <translation>显示的点</translation>
    </message>
    <message>
        <source>Crop…</source>
        <translation>裁剪…</translation>
    </message>
    <message>
        <source>Show a box with handles: the board is searched inside it only (C)</source>
        <translation>显示带手柄的框：只在框内搜索标定板 (C)</translation>
    </message>
    <message>
        <source>Number of points shown</source>
        <translation>显示的点数</translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 个点</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>扫描线</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>时间</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>坐标轴</translation>
    </message>
    <message>
        <source>Show the LiDAR&apos;s axes (x red, y green, z blue) and a grid under the points</source>
        <translation>显示激光雷达坐标轴（x 红、y 绿、z 蓝）和点云下方的网格</translation>
    </message>
    <message>
        <source>Size of the points on the screen, px</source>
        <translation>点在屏幕上的大小，px</translation>
    </message>
    <message>
        <source>Size of the points</source>
        <translation>点的大小</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>未采用</translation>
    </message>
    <message>
        <source>Mark the points on the board that are not used: refused by the program (red crosses), left out by hand (violet crosses)</source>
        <translation>标出标定板上未采用的点：被程序拒绝的（红叉）、手动排除的（紫叉）</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a line about points to select them, at whatever depth. With Shift they are added to those selected (L)</source>
        <translation>圈住要选中的点，不论远近。按住 Shift 则加入已选中的点（L）</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>What the colours tell: intensity as recorded, height z (m), range (m), what the model in force leaves of the range, averaged over the board (mm), the camera&apos;s own colours, the scan line&apos;s number, or the time since the scan began (ms)</source>
        <translation>颜色的含义：记录的强度、高度 z (m)、距离 (m)、当前模型留下的距离残差（在标定板上取平均，mm）、相机颜色、扫描线号，或扫描开始后的时间 (ms)</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudSceneBuilder</name>
    <message>
        <source>There is not enough memory to show this cloud.</source>
        <translation>内存不足，无法显示该点云。</translation>
    </message>
    <message>
        <source>This cloud cannot be shown: %1</source>
        <translation>无法显示此点云：%1</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CloudView</name>
    <message>
        <source>Point cloud</source>
        <translation>点云</translation>
    </message>
    <message>
        <source>The cloud cannot be drawn: no OpenGL 3.2 on this screen.
Install a graphics driver (or Mesa&apos;s software renderer).</source>
        <translation>无法绘制点云：此屏幕不支持 OpenGL 3.2。
请安装显卡驱动（或 Mesa 软件渲染器）。</translation>
    </message>
    <message>
        <source>Drag: turn. Shift+drag or middle button: move. Wheel or right button: zoom. Click: values of a point. Lengths in metres.</source>
        <translation>拖动：旋转。Shift+拖动或中键：平移。滚轮或右键：缩放。单击：显示点的数值。长度单位为米。</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>复位</translation>
    </message>
    <message>
        <source>Show all points obliquely</source>
        <translation>斜视显示全部点</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>俯视</translation>
    </message>
    <message>
        <source>Look from above</source>
        <translation>从上方看</translation>
    </message>
    <message>
        <source>Sensor</source>
        <translation>传感器</translation>
    </message>
    <message>
        <source>Look from the LiDAR&apos;s origin</source>
        <translation>从激光雷达原点看</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>Look at the board, once it is found</source>
        <translation>找到标定板后对准它观看</translation>
    </message>
    <message>
        <source>The board from behind</source>
        <translation>从背面看标定板</translation>
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
    <name>lvcalib::widgets::ColorBar</name>
    <message>
        <source>Drag the ends of the colours; a double click takes them back</source>
        <translation>拖动颜色范围的两端；双击恢复</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CompareDialog</name>
    <message>
        <source>They differ by %1 mm and %2 mrad.</source>
        <translation>两者相差 %1 mm 和 %2 mrad。</translation>
    </message>
    <message>
        <source>They contradict each other: the stated uncertainties explain such a difference in %1 % of all cases only.</source>
        <translation>两者矛盾：按所给的不确定度，只有 %1 % 的情况会有这样的差异。</translation>
    </message>
    <message>
        <source>That is much: the stated uncertainties explain such a difference in %1 % of all cases.</source>
        <translation>差异较大：按所给的不确定度，%1 % 的情况会有这样的差异。</translation>
    </message>
    <message>
        <source>They agree: by their stated uncertainties differences are as large or larger in %1 % of all cases.</source>
        <translation>两者一致：按所给的不确定度，%1 % 的情况差异会同样大或更大。</translation>
    </message>
    <message>
        <source>This holds for results from data of their own.</source>
        <translation>这适用于由各自数据得到的结果。</translation>
    </message>
    <message>
        <source>In the camera&apos;s axes</source>
        <translation>沿相机坐标轴</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>差异</translation>
    </message>
    <message>
        <source>± of the difference</source>
        <translation>± 差异</translation>
    </message>
    <message>
        <source>In ±</source>
        <translation>以 ± 计</translation>
    </message>
    <message>
        <source>translation x, mm</source>
        <translation>平移 x，mm</translation>
    </message>
    <message>
        <source>translation y, mm</source>
        <translation>平移 y，mm</translation>
    </message>
    <message>
        <source>translation z, mm</source>
        <translation>平移 z，mm</translation>
    </message>
    <message>
        <source>rotation about x, mrad</source>
        <translation>绕 x 旋转，mrad</translation>
    </message>
    <message>
        <source>rotation about y, mrad</source>
        <translation>绕 y 旋转，mrad</translation>
    </message>
    <message>
        <source>rotation about z, mrad</source>
        <translation>绕 z 旋转，mrad</translation>
    </message>
    <message>
        <source>Compare results</source>
        <translation>比较结果</translation>
    </message>
    <message>
        <source>nothing chosen yet</source>
        <translation>尚未选择</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>File %1</source>
        <translation>文件 %1</translation>
    </message>
    <message>
        <source>Project %1</source>
        <translation>项目 %1</translation>
    </message>
    <message>
        <source>This project</source>
        <translation>本项目</translation>
    </message>
    <message>
        <source>This project, step %1: %2</source>
        <translation>本项目，第 %1 步：%2</translation>
    </message>
    <message>
        <source>Being compared …</source>
        <translation>正在比较…</translation>
    </message>
    <message>
        <source>Cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>Choose another result, the truth of a simulation, or another project to compare with.</source>
        <translation>请选择要与之比较的另一个结果、仿真真值或另一个项目。</translation>
    </message>
    <message>
        <source>Both rest on the same scenes: chance moves both alike, and what differs is what was decided or the model. The ± of the difference would hold for results from data of their own.</source>
        <translation>两者基于相同的场景：偶然误差对两者的影响相同，不同的是所作的决定或模型。差值的 ± 适用于各自使用独立数据的结果。</translation>
    </message>
    <message>
        <source>One of them states no uncertainty.</source>
        <translation>其中一个没有给出不确定度。</translation>
    </message>
    <message>
        <source>± from</source>
        <translation>± 起始</translation>
    </message>
    <message>
        <source>± to</source>
        <translation>± 目标</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>px from</source>
        <translation>px 起始</translation>
    </message>
    <message>
        <source>px to</source>
        <translation>px 目标</translation>
    </message>
    <message>
        <source>mm from</source>
        <translation>mm 起始</translation>
    </message>
    <message>
        <source>mm to</source>
        <translation>mm 目标</translation>
    </message>
    <message>
        <source>Moves, px</source>
        <translation>移动 px</translation>
    </message>
    <message>
        <source>Root mean square of the corners&apos; residuals</source>
        <translation>角点残差的均方根</translation>
    </message>
    <message>
        <source>Root mean square of the LiDAR&apos;s residuals</source>
        <translation>激光雷达残差的均方根</translation>
    </message>
    <message>
        <source>How far the board of the scene moves in the picture, root mean square over it</source>
        <translation>该场景的标定板在图像中移动多少（板面上的均方根）</translation>
    </message>
    <message>
        <source>Left out of one result, or of both</source>
        <translation>未用于其中一个或两个结果</translation>
    </message>
    <message>
        <source>The image is being loaded …</source>
        <translation>正在载入图像…</translation>
    </message>
    <message>
        <source>This scene is not in the project that is open.</source>
        <translation>打开的项目中没有该场景。</translation>
    </message>
    <message>
        <source>There is no image: %1</source>
        <translation>没有图像：%1</translation>
    </message>
    <message>
        <source>from</source>
        <translation>起始</translation>
    </message>
    <message>
        <source>to</source>
        <translation>目标</translation>
    </message>
    <message>
        <source>&amp;From</source>
        <translation>起始(&amp;F)</translation>
    </message>
    <message>
        <source>&amp;To</source>
        <translation>目标(&amp;T)</translation>
    </message>
    <message>
        <source>&amp;Result file…</source>
        <translation>结果文件(&amp;R)…</translation>
    </message>
    <message>
        <source>A result.json or result.yaml, or the truth of a simulation</source>
        <translation>result.json 或 result.yaml，或仿真真值</translation>
    </message>
    <message>
        <source>&amp;Project…</source>
        <translation>项目(&amp;P)…</translation>
    </message>
    <message>
        <source>Another project: it is calibrated for this</source>
        <translation>另一个项目：为此对其进行标定</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点</translation>
    </message>
    <message>
        <source>The LiDAR&apos;s points on the board, as either projects them</source>
        <translation>标定板上的激光雷达点，按两者各自的投影</translation>
    </message>
    <message>
        <source>&amp;Arrows</source>
        <translation>箭头(&amp;A)</translation>
    </message>
    <message>
        <source>How much longer than they are the arrows are drawn, which lead from where the one projects the board to where the other does</source>
        <translation>箭头放大的倍数；箭头由一方投影的标定板位置指向另一方投影的位置</translation>
    </message>
    <message>
        <source>Enlargement of the arrows</source>
        <translation>箭头的放大倍数</translation>
    </message>
    <message>
        <source>shift of the board</source>
        <translation>标定板的位移</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ConvergencePlot</name>
    <message>
        <source>iteration</source>
        <translation>迭代</translation>
    </message>
    <message>
        <source>move (mm)</source>
        <translation>移动量 (mm)</translation>
    </message>
    <message>
        <source>Thin lines: size of each circle&apos;s own correction in every iteration (mm), which ends at its measurement noise. Thick line: largest move of a centre after the projection to the layout; the refinement ends when it is small.</source>
        <translation>细线：每次迭代中各圆自身修正量的大小 (mm)，最终降到其测量噪声。粗线：投影到布局之后圆心的最大移动量；足够小时精化结束。</translation>
    </message>
    <message>
        <source>no iterations</source>
        <translation>没有迭代</translation>
    </message>
    <message>
        <source>circle %1</source>
        <translation>圆 %1</translation>
    </message>
    <message>
        <source>each circle</source>
        <translation>各圆</translation>
    </message>
    <message>
        <source>layout</source>
        <translation>布局</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CorrectDialog</name>
    <message>
        <source>The model in force holds no effects: clouds would stay as they are. Add effects on the Model page first.</source>
        <translation>当前模型不含效应：点云不会改变。请先在“模型”页添加效应。</translation>
    </message>
    <message>
        <source>Cancelled; clouds that were complete stay.</source>
        <translation>已取消；已完成的点云保留。</translation>
    </message>
    <message>
        <source>%1: %2 mm RMS</source>
        <translation>%1：RMS %2 mm</translation>
    </message>
    <message>
        <source>%1: left, it drifts with time</source>
        <translation>%1：保留，它随时间漂移</translation>
    </message>
    <message>
        <source>%1: left, it is known on the board only</source>
        <translation>%1：保留，只在标定板上已知</translation>
    </message>
    <message>
        <source>%1: left, it does not move points</source>
        <translation>%1：保留，它不移动点</translation>
    </message>
    <message>
        <source>%1 points are darker, brighter or more slanted than the board was; they get the correction at its limits.</source>
        <translation>%1 个点比标定板更暗、更亮或更倾斜；按极限值校正。</translation>
    </message>
    <message>
        <source>Correct clouds</source>
        <translation>校正点云</translation>
    </message>
    <message>
        <source>&amp;From:</source>
        <translation>来源(&amp;F)：</translation>
    </message>
    <message>
        <source>&amp;To:</source>
        <translation>目标(&amp;T)：</translation>
    </message>
    <message>
        <source>&amp;Cloud…</source>
        <translation>点云(&amp;C)…</translation>
    </message>
    <message>
        <source>F&amp;older…</source>
        <translation>文件夹(&amp;O)…</translation>
    </message>
    <message>
        <source>&amp;Place…</source>
        <translation>位置(&amp;P)…</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>停止(&amp;S)</translation>
    </message>
    <message>
        <source>Co&amp;rrect</source>
        <translation>校正(&amp;R)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Taken out of clouds of this LiDAR:</source>
        <translation>从此激光雷达的点云中去除：</translation>
    </message>
    <message>
        <source>Effects that are not ticked stay in the clouds</source>
        <translation>未勾选的效应保留在点云中</translation>
    </message>
    <message>
        <source>&amp;When the clouds were taken:</source>
        <translation>点云的采集时刻(&amp;W)：</translation>
    </message>
    <message>
        <source>0 % with the first scene of the calibration, 100 % with the last. Effects that drift from scene to scene are taken out only if this is known.</source>
        <translation>0 % 为标定的第一个场景时，100 % 为最后一个场景时。随场景漂移的效应只有在已知该时刻时才会去除。</translation>
    </message>
    <message>
        <source>of the way from the first scene to the last</source>
        <translation>（从第一个场景到最后一个场景）</translation>
    </message>
    <message numerus="yes">
        <source>%n clouds, %1 points, moved by %2 mm RMS, %3 mm at most.</source>
        <translation>
            <numerusform>%n 个点云，%1 个点，移动 RMS %2 mm，最大 %3 mm。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CorrectionWork</name>
    <message>
        <source>is the cloud itself, which stays as it is</source>
        <translation>就是点云本身，它保持不变</translation>
    </message>
    <message>
        <source>choose another place for what is corrected</source>
        <translation>请为校正结果选择另一位置</translation>
    </message>
    <message>
        <source>holds no clouds (.pcd or .ply)</source>
        <translation>不含点云（.pcd 或 .ply）</translation>
    </message>
    <message>
        <source>choose a cloud, or a folder of clouds</source>
        <translation>请选择点云或点云文件夹</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::CropForm</name>
    <message>
        <source>roll</source>
        <translation>横滚</translation>
    </message>
    <message>
        <source>pitch</source>
        <translation>俯仰</translation>
    </message>
    <message>
        <source>yaw</source>
        <translation>偏航</translation>
    </message>
    <message>
        <source>Middle %1</source>
        <translation>中心 %1</translation>
    </message>
    <message>
        <source>Middle of the box along the LiDAR&apos;s %1 axis, in metres</source>
        <translation>框中心沿激光雷达 %1 轴的坐标（米）</translation>
    </message>
    <message>
        <source>Side %1</source>
        <translation>边长 %1</translation>
    </message>
    <message>
        <source>Length of the box along its own %1 axis, in metres</source>
        <translation>框沿自身 %1 轴的长度（米）</translation>
    </message>
    <message>
        <source>Turn of the box (%1), in degrees: roll about x, then pitch about y, then yaw about z of the LiDAR</source>
        <translation>框的转角（%1），单位为度：依次绕激光雷达 x 轴横滚、绕 y 轴俯仰、绕 z 轴偏航</translation>
    </message>
    <message>
        <source>Use this crop</source>
        <translation>使用此裁剪</translation>
    </message>
    <message>
        <source>Search the board only inside the box; runs this scene again from there</source>
        <translation>只在框内搜索标定板；该场景由此重新运行</translation>
    </message>
    <message>
        <source>No crop</source>
        <translation>不裁剪</translation>
    </message>
    <message>
        <source>Search the board in the whole cloud again</source>
        <translation>重新在完整点云中搜索标定板</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::DemoTour</name>
    <message>
        <source>These scenes were simulated just now, by a LiDAR with an error that the calibration does not know. Press &lt;b&gt;Run all&lt;/b&gt;.</source>
        <translation>这些场景刚刚模拟生成，所用激光雷达有一个标定并不知道的误差。请按&lt;b&gt;全部运行&lt;/b&gt;。</translation>
    </message>
    <message>
        <source>The effects that may be missing are being tried; scenes held out decide. The best one comes first, with a sentence on what was seen and how sure that is.</source>
        <translation>正在逐一尝试可能遗漏的效应，由留出的场景决定。最好的排在最前，并用一句话说明看到了什么、有多大把握。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Add&lt;/b&gt; it to the model.</source>
        <translation>把它&lt;b&gt;添加&lt;/b&gt;到模型中。</translation>
    </message>
    <message>
        <source>The calibration is done. Below on the right stands how far it can be trusted, and the mouse over it says why. Open the &lt;b&gt;Model&lt;/b&gt; page to ask what the model misses.</source>
        <translation>标定完成。右下角说明结果的可信程度，鼠标悬停可看原因。打开&lt;b&gt;模型&lt;/b&gt;页，看看模型缺少什么。</translation>
    </message>
    <message>
        <source>The effect at the top of the list is the one that scenes held out speak for most. The orange curve is its pattern at the size found; the marks are what is measured.</source>
        <translation>列表最上方的效应最受留出场景支持。橙色曲线是它按所求大小的形态；标记是测量值。</translation>
    </message>
    <message>
        <source>Red is what no effect explains, green what the model explains now; diamonds are scenes held out. The list on the left says by how much the extrinsic has moved. Click an earlier step or undo to compare.</source>
        <translation>红色是没有效应能解释的部分，绿色是模型现在解释的部分；菱形是留出场景。左侧列表说明外参移动了多少。点击先前的步骤或撤销以作比较。</translation>
    </message>
    <message>
        <source>The calibration runs; what it is at stands below on the left. Meanwhile the window can be used: the &lt;b&gt;Refinement&lt;/b&gt; page shows how the circles are found.</source>
        <translation>标定正在进行，左下方显示进行到哪一步。其间窗口仍可使用：&lt;b&gt;精化&lt;/b&gt;页显示各圆是如何找到的。</translation>
    </message>
    <message>
        <source>The calibration has run. What it is at stands below on the left; meanwhile the window can be used. The &lt;b&gt;Refinement&lt;/b&gt; page shows how the circles were found.</source>
        <translation>标定已运行完毕。运行到哪一步显示在左下方，其间窗口仍可使用。&lt;b&gt;精化&lt;/b&gt;页显示各圆是如何找到的。</translation>
    </message>
    <message>
        <source>The effects that may be missing have been tried; scenes held out decided. The best one comes first, with a sentence on what was seen and how sure that is.</source>
        <translation>可能遗漏的效应已逐一尝试，由留出的场景决定。最好的排在最前，并用一句话说明看到了什么、有多大把握。</translation>
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
    <name>lvcalib::widgets::ExportPane</name>
    <message>
        <source>Formats</source>
        <translation>格式</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>预览</translation>
    </message>
    <message>
        <source>A YAML file with T_imu_lidar, which takes a LiDAR point to the IMU frame: a matrix, or translation_m and quaternion_xyzw</source>
        <translation>包含 T_imu_lidar（将激光点变换到 IMU 坐标系）的 YAML 文件：矩阵，或 translation_m 和 quaternion_xyzw</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>复制</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>保存…</translation>
    </message>
    <message>
        <source>Needs T_imu_lidar: choose the YAML file that holds it.</source>
        <translation>需要 T_imu_lidar：请选择包含它的 YAML 文件。</translation>
    </message>
    <message>
        <source>%1 (*.%2);;All files (*)</source>
        <translation>%1 (*.%2);;所有文件 (*)</translation>
    </message>
    <message>
        <source>Frames:</source>
        <translation>坐标系：</translation>
    </message>
    <message>
        <source>What the LiDAR&apos;s frame is called in exports</source>
        <translation>导出时激光雷达坐标系的名称</translation>
    </message>
    <message>
        <source>LiDAR frame</source>
        <translation>激光雷达坐标系</translation>
    </message>
    <message>
        <source>What the camera&apos;s frame is called in exports</source>
        <translation>导出时相机坐标系的名称</translation>
    </message>
    <message>
        <source>Camera frame</source>
        <translation>相机坐标系</translation>
    </message>
    <message>
        <source>The scene whose cloud is written</source>
        <translation>要写出点云的场景</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ExtrinsicPage</name>
    <message>
        <source>Pose and quality</source>
        <translation>位姿与质量</translation>
    </message>
    <message>
        <source>corner RMS (px)</source>
        <translation>角点 RMS (px)</translation>
    </message>
    <message>
        <source>LiDAR RMS (mm)</source>
        <translation>激光雷达 RMS (mm)</translation>
    </message>
    <message>
        <source>corner residual (px)</source>
        <translation>角点残差 (px)</translation>
    </message>
    <message>
        <source>node residual (mm)</source>
        <translation>节点残差 (mm)</translation>
    </message>
    <message>
        <source>moves without it (mm)</source>
        <translation>去掉后的移动 (mm)</translation>
    </message>
    <message>
        <source>turns without it (mrad)</source>
        <translation>去掉后的转动 (mrad)</translation>
    </message>
    <message>
        <source>Root mean square of the tag corners&apos; reprojection residuals, per scene (px). Pale: not used. Click: go to the scene.</source>
        <translation>各场景标签角点重投影残差的均方根 (px)。浅色：未使用。单击：转到该场景。</translation>
    </message>
    <message>
        <source>Root mean square of the refined LiDAR nodes against the board&apos;s model, per scene (mm); without circles, of the plane&apos;s height</source>
        <translation>各场景精化后的激光节点与标定板模型之差的均方根 (mm)；没有圆时为平面高度之差</translation>
    </message>
    <message>
        <source>How far the LiDAR&apos;s origin moves when the scene is left out (mm)</source>
        <translation>去掉该场景时激光雷达原点的移动量 (mm)</translation>
    </message>
    <message>
        <source>How far the extrinsic turns when the scene is left out (mrad)</source>
        <translation>去掉该场景时外参的转动量 (mrad)</translation>
    </message>
    <message>
        <source>Run the calibration to see its result.</source>
        <translation>运行标定后可查看结果。</translation>
    </message>
    <message>
        <source>this board has no circles</source>
        <translation>该标定板没有圆</translation>
    </message>
    <message>
        <source>needs three used scenes or more</source>
        <translation>需要三个或更多使用中的场景</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>不确定度</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>Thresholds</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>All scenes</source>
        <translation>全部场景</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>着色</translation>
    </message>
    <message>
        <source>Residuals and influence of every scene</source>
        <translation>每个场景的残差与影响</translation>
    </message>
    <message>
        <source>The cloud in the camera&apos;s colours</source>
        <translation>以相机颜色着色的点云</translation>
    </message>
    <message>
        <source>Leave these scenes out</source>
        <translation>剔除这些场景</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>返回</translation>
    </message>
    <message>
        <source>Drag the dashed line down over the bars to see what the extrinsic would be without the scenes above it.</source>
        <translation>将虚线向下拖过柱形，可查看去掉线以上的场景后外参会怎样。</translation>
    </message>
    <message>
        <source>Solving without %1 …</source>
        <translation>正在求解（不含 %1）…</translation>
    </message>
    <message>
        <source>Without %1:</source>
        <translation>不含 %1：</translation>
    </message>
    <message>
        <source>Lengths of the corner residuals per scene (px): median, quartiles, whiskers to 1.5 box lengths, circles beyond; red crosses: left out (triangles: higher than drawn)</source>
        <translation>各场景角点残差的长度 (px)：中位数、四分位数、1.5 倍箱长的须线，之外为圆圈；红叉：未采用（三角：实际更高）</translation>
    </message>
    <message>
        <source>Lengths of the node residuals per scene (mm): median, quartiles, whiskers to 1.5 box lengths, circles beyond; red crosses: left out (triangles: higher than drawn)</source>
        <translation>各场景节点残差的长度 (mm)：中位数、四分位数、1.5 倍箱长的须线，之外为圆圈；红叉：未采用（三角：实际更高）</translation>
    </message>
    <message>
        <source>Too few: no scene would be left below the line. Drag it up to keep one or more.</source>
        <translation>场景太少：线下一个场景也不剩。请把线向上拖，至少保留一个场景。</translation>
    </message>
    <message>
        <source>Without %1 there is no result: %2</source>
        <translation>去掉 %1 后没有结果：%2</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::FigureActions</name>
    <message>
        <source>Save figure</source>
        <translation>保存图形</translation>
    </message>
    <message>
        <source>Save as PNG…</source>
        <translation>另存为 PNG…</translation>
    </message>
    <message>
        <source>PNG image (*.png)</source>
        <translation>PNG 图像 (*.png)</translation>
    </message>
    <message>
        <source>Save as PDF…</source>
        <translation>另存为 PDF…</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>Save data as CSV…</source>
        <translation>将数据存为 CSV…</translation>
    </message>
    <message>
        <source>Comma-separated values (*.csv)</source>
        <translation>逗号分隔值 (*.csv)</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::FilesDialog</name>
    <message>
        <source>none yet</source>
        <translation>暂无</translation>
    </message>
    <message>
        <source>Choose a camera file…</source>
        <translation>选择相机文件…</translation>
    </message>
    <message>
        <source>Make a camera.yaml…</source>
        <translation>新建 camera.yaml…</translation>
    </message>
    <message>
        <source>seen</source>
        <translation>可见</translation>
    </message>
    <message>
        <source>not seen: %1</source>
        <translation>不可见：%1</translation>
    </message>
    <message>
        <source>Matched by their names</source>
        <translation>按名称配对</translation>
    </message>
    <message>
        <source>Matched by the numbers in their names</source>
        <translation>按名称中的编号配对</translation>
    </message>
    <message>
        <source>Matched by the times that are their names</source>
        <translation>按文件名中的时间配对</translation>
    </message>
    <message>
        <source>Files of %1</source>
        <translation>%1 的文件</translation>
    </message>
    <message>
        <source>without a partner: %1</source>
        <translation>没有配对：%1</translation>
    </message>
    <message>
        <source>Choose the folder that holds the images, or all files.</source>
        <translation>请选择图像或全部文件所在的文件夹。</translation>
    </message>
    <message>
        <source>Tick the pairs that are to become scenes.</source>
        <translation>请勾选要成为场景的文件对。</translation>
    </message>
    <message>
        <source>Choose a folder for the dataset.</source>
        <translation>请为数据集选择文件夹。</translation>
    </message>
    <message>
        <source>%1 of %2 pairs become scenes</source>
        <translation>%2 对中有 %1 对成为场景</translation>
    </message>
    <message>
        <source>New from files</source>
        <translation>从文件新建</translation>
    </message>
    <message>
        <source>I&amp;mages in:</source>
        <translation>图像位于(&amp;M)：</translation>
    </message>
    <message>
        <source>C&amp;louds in:</source>
        <translation>点云位于(&amp;L)：</translation>
    </message>
    <message>
        <source>Matched &amp;by:</source>
        <translation>配对依据(&amp;B)：</translation>
    </message>
    <message>
        <source>At most a&amp;part:</source>
        <translation>最大间隔(&amp;P)：</translation>
    </message>
    <message>
        <source>I&amp;ntrinsics:</source>
        <translation>内参(&amp;N)：</translation>
    </message>
    <message>
        <source>Boa&amp;rd:</source>
        <translation>标定板(&amp;R)：</translation>
    </message>
    <message>
        <source>&amp;Dataset folder:</source>
        <translation>数据集文件夹(&amp;D)：</translation>
    </message>
    <message>
        <source>B&amp;rowse…</source>
        <translation>浏览(&amp;R)…</translation>
    </message>
    <message>
        <source>Br&amp;owse…</source>
        <translation>浏览(&amp;O)…</translation>
    </message>
    <message>
        <source>Bro&amp;wse…</source>
        <translation>浏览(&amp;W)…</translation>
    </message>
    <message>
        <source>A folder of images, or one that holds all: of KITTI raw, cam_lidar_calibration, direct_visual_lidar_calibration, FAST-Calib, or two folders</source>
        <translation>图像的文件夹，或包含全部文件的文件夹：KITTI raw、cam_lidar_calibration、direct_visual_lidar_calibration、FAST-Calib，或两个文件夹</translation>
    </message>
    <message>
        <source>the same folder, or one in it</source>
        <translation>同一文件夹或其中的子文件夹</translation>
    </message>
    <message>
        <source>their names, or else their times</source>
        <translation>名称，否则时间</translation>
    </message>
    <message>
        <source>their names</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>the times that are their names</source>
        <translation>文件名中的时间</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>half of the usual time between two</source>
        <translation>通常间隔的一半</translation>
    </message>
    <message>
        <source>Files whose times differ by more do not belong together</source>
        <translation>时间相差更多的文件不配对</translation>
    </message>
    <message>
        <source>Intrinsics that lie with the files, or a camera.yaml</source>
        <translation>文件旁的内参，或 camera.yaml</translation>
    </message>
    <message>
        <source>Replace the earlier import</source>
        <translation>替换之前的导入</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>Cloud</source>
        <translation>点云</translation>
    </message>
    <message>
        <source>Apart</source>
        <translation>间隔</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
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
1. **Print the board** at 1:1 with *Tools › Print the board…*, glue it on something flat and measure a tag.
2. **Take three to ten scenes**: the board at 2–4 m, turned differently each time, seen whole by both sensors.
3. **Open them**: *File › New from recording…* makes a dataset of a bag; or lay out a folder with `target.yaml`, `camera.yaml`, `scenes/NAME/image.png` and `scenes/NAME/cloud.pcd` and open that.
4. **Press F5.** No rough guess is needed.
5. **Look**: every scene should be *used*; a scene whose px, mm or influence stands out deserves a look on the Scene page. Untick it and the result follows at once.
6. **Ask what is missing** on the Model page.
7. **Export** with Ctrl+E.
</source>
        <translation># 从标定板到结果
1. **打印标定板**：用“工具 › 打印标定板…”按 1:1 打印，贴在平整的板上，并量一个标签的边长。
2. **拍摄三到十个场景**：标定板在 2–4 m 处，每次朝向不同，两个传感器都能看到整块板。
3. **打开它们**：“文件 › 从记录新建…”可由录制包生成数据集；或者按 `target.yaml`、`camera.yaml`、`scenes/NAME/image.png` 和 `scenes/NAME/cloud.pcd` 整理文件夹后打开。
4. **按 F5。** 不需要初始估计。
5. **查看**：每个场景都应为“采用”；px、mm 或影响突出的场景值得在“场景”页上细看。取消勾选后结果立即更新。
6. 在“模型”页上**查看缺少什么**。
7. 用 Ctrl+E **导出**。
</translation>
    </message>
    <message>
        <source># Scene
Cloud and image of the scene that is selected in the list, with what was found in them. A click in one view shows the same thing in the other.

- **Brush** (L): draw a line about points, tags or circles to select them; Shift adds. *Exclude these* leaves them out, and *Take back* brings them back. A patch of the board can be left out of every scene: a stain, a screw, a bent corner.
- What is not used is hatched and crossed out: red where the program refused it, violet where you did. *Use it all the same* overrules the program.
- **Crop…** (C) helps where the board is not found.
</source>
        <translation># 场景
列表中所选场景的点云和图像，以及在其中找到的内容。在一个视图中单击，另一个视图显示同一处。

- **刷选**（L）：圈住点、标签或圆即可选中；按住 Shift 则追加。“排除所选”不再采用它们，“恢复”则重新采用。标定板的某一块可在所有场景中排除：污渍、螺钉、翘角。
- 未采用的内容以阴影线和叉号标出：被程序拒绝的为红色，您排除的为紫色。“仍然采用”可推翻程序的决定。
- **裁剪…**（C）在找不到标定板时有帮助。
</translation>
    </message>
    <message>
        <source># Boundary response
How returns scatter at the circles&apos; edges: the transition of the intensity, pitch and yaw with their ellipse, and ranges off the plane. The table has the numbers for all scenes and each one. *Left out* lists what the program refused, with its reasons.
</source>
        <translation># 边界响应
回波在圆的边缘如何散布：强度的过渡、俯仰与偏航及其椭圆，以及偏离平面的距离。表格给出全部场景和各个场景的数值。“未采用”列出程序拒绝的内容及原因。
</translation>
    </message>
    <message>
        <source># Keys
F5 runs all, Esc cancels, Ctrl+Z undoes, Ctrl+1, Ctrl+2 … change the page, Ctrl+J rejects and Ctrl+U accepts the selected scenes, Space ticks and unticks, Alt+Up and Alt+Down move them in the list, F1 opens this guide at the page in view.
</source>
        <translation># 快捷键
F5 全部运行，Esc 取消，Ctrl+Z 撤销，Ctrl+1、Ctrl+2 …… 切换页面，Ctrl+J 拒绝、Ctrl+U 接受所选场景，空格键勾选或取消勾选，Alt+上、Alt+下 在列表中移动场景，F1 在当前页面对应的章节打开本指南。
</translation>
    </message>
    <message>
        <source># Refinement
How each circle&apos;s centre was found, bin by bin: marks where the intensity crosses its middle level, and the fitted wave. A centred circle has a flat line at zero. A click enlarges a circle and says why bins were refused. Circles that the solve left out are struck through.
</source>
        <translation># 精化
每个圆的圆心是如何逐个角度区间找到的：强度穿过中间水平处的标记，以及拟合的波形。居中的圆在零处为一条平线。单击可放大某个圆并说明区间被拒绝的原因。求解未采用的圆被划掉。
</translation>
    </message>
    <message>
        <source># Extrinsic
The pose, its standard deviations and the verdict. *Residuals* has a column for each scene; red crosses are left out. Drag the dashed line down over the bars to see what the extrinsic would be without the scenes above it. *Methods* solves the same scenes in other ways; *Thresholds* shows what tags and circles miss the board&apos;s pose by, with the gate as a line to drag: what would be refused and where the extrinsic would go is told before it is decided. *All scenes* shows every board about the rig.
</source>
        <translation># 外参
位姿、其标准差和结论。“残差” 中每个场景占一列；红叉为未采用的部分。将虚线向下拖过柱形，可查看去掉线以上的场景后外参会怎样。“方法” 以其他方式求解相同的场景；“阈值” 显示标签和圆偏离标定板位姿的程度，门限是一条可拖动的线：在作出决定之前即说明会拒绝什么、外参会移到哪里。“全部场景” 显示设备周围的所有标定板。
</translation>
    </message>
    <message>
        <source># Camera
The intrinsics as given, as estimated with the extrinsic and from images alone, with their standard deviations, and what the images say against them. Every image is listed with what its corners miss the camera by.

- **Add images…** takes images of the board without a cloud: they count for the camera alone. Bring the board to all parts of the image, turned another way each time.
- **Calibrate the camera** needs the images only; distortion models are compared on images that they were not fitted to. *Save camera.yaml…* keeps it.
- *Residuals* shows as arrows what the corners miss the camera by; *Uncertainty* how well a direction is known over the image.
- Whether the extrinsic&apos;s solve takes the intrinsics as given or estimates them is an option of the parameters.
</source>
        <translation># 相机
内参的给定值、与外参一同估计的值和仅由图像得到的值并列显示，各附标准差，并说明图像对它们的异议。每幅图像都列出其角点偏离相机模型的程度。

- **添加图像…** 接收没有点云的标定板图像：它们只用于相机。请把标定板带到图像的各个部分，每次转向不同的方向。
- **标定相机** 只需要图像；各畸变模型在未参与拟合的图像上比较。用 *保存 camera.yaml…* 保存结果。
- *残差* 用箭头显示角点偏离相机模型的程度；*不确定度* 显示图像各处方向的精度。
- 求解外参时内参按给定值使用还是一同估计，是参数中的一个选项。
</translation>
    </message>
    <message>
        <source># Tools
*Plan scenes* says where to hold the board next and how sure the extrinsic is then. *File › Watch* takes scenes as they come and shows the next pose in large letters. *Check on fresh data* lays the pose over pictures with or without a board and says whether edges of LiDAR and image agree; there a rough pose is also found by hand. *Compare with* sets two results side by side, *Correct clouds* takes the model&apos;s effects out of clouds, *Calibrate a camera* makes a camera.yaml of a folder of images, and the board is printed and described from the same menu.
</source>
        <translation># 工具
*规划场景*说明下一步把标定板放在哪里，以及届时外参有多可靠。*文件 › 监视*在场景出现时即行采用，并以大字显示下一个位姿。*用新数据检验*把位姿叠加到有无标定板的画面上，说明激光雷达与图像的边缘是否吻合；也可在那里手动寻找粗略位姿。*比较*把两个结果并列，*校正点云*从点云中去除模型的效应，*标定相机*由图像文件夹生成 camera.yaml；标定板的打印和描述也在同一菜单中。
</translation>
    </message>
    <message>
        <source># Model
Compare, locate, learn, add, watch: what the model misses, and what that does to the pose.

- **Bars on top**: the error beyond the noise after each step, red where it is unexplained, green where an effect took it away, grey where chance alone may leave it. A click goes to a step; *Compare steps…* sets two of them side by side. Where the truth of a simulation is known, the distance to it stands beside the bars.
- **Where it fails**, in the middle: residuals of a channel against whatever they may depend on, as a scatter with binned means or as maps over the image, the board and the directions. *Before* draws what was there before the last step. *Brush* selects measurements, which are then marked on the Scene page too; *Exclude these* leaves them out of all scenes.
- **What is missing**, on the right: effects with the evidence of the scenes held out. *Add* takes one into the model, *Find all* goes on until nothing is missing. *Cannot be seen* lists effects that these scenes would not show, and how far they could still move the pose.
- **The model**, on the left: its effects with their values. Untick one to take it out, hold a value to fix it, *Add…* enters an effect as a formula or a curve. *What if* draws an effect over the residuals before it is in the model.
- &quot;One of several&quot; means that these scenes cannot tell effects apart; the text names the scene that would.
</source>
        <translation># 模型
比较、定位、了解、添加、观察：模型缺少什么，以及这对位姿有何影响。

- **上方的柱形**：每一步之后超出噪声的误差；红色为未解释的部分，绿色为已由效应解释的部分，灰色为仅由偶然误差就可能留下的部分。单击可转到某一步；“比较步骤…” 将两步并列。若仿真真值已知，与真值的距离显示在柱形旁边。
- **失效之处**（中间）：某一通道的残差与其可能依赖的量的关系，以散点和分箱均值，或以图像、标定板和方向上的分布图表示。“之前” 绘出上一步之前的情况。“刷选” 选择测量值，它们随后也在“场景”页中标出；“排除所选” 在所有场景中不再采用它们。
- **缺失的内容**（右侧）：各效应及留出场景给出的证据。“添加” 将其加入模型，“全部查找” 持续到不再缺失为止。“看不到的” 列出这些场景无法显示的效应，以及它们还能使位姿移动多少。
- **模型**（左侧）：其效应及数值。取消勾选即移除，固定数值即不再拟合，“添加…” 以公式或曲线输入效应。“假如” 在效应加入模型之前将其绘在残差上。
- “若干之一”表示这些场景无法区分几个效应；文字会指出能够区分的场景。
</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImagePane</name>
    <message>
        <source>Image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>Tags</source>
        <translation>标签</translation>
    </message>
    <message>
        <source>Outlines and ids of the detected tags (green)</source>
        <translation>检测到的标签的轮廓和编号（绿色）</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>Detected minus predicted corner (px), enlarged (magenta arrows)</source>
        <translation>检测角点减预测角点 (px)，放大显示（洋红箭头）</translation>
    </message>
    <message>
        <source>How much longer than life residual arrows are drawn</source>
        <translation>残差箭头的放大倍数</translation>
    </message>
    <message>
        <source>Enlargement of residuals</source>
        <translation>残差放大倍数</translation>
    </message>
    <message>
        <source>Circles</source>
        <translation>圆</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>点</translation>
    </message>
    <message>
        <source>The points of the cloud view, projected with the extrinsic</source>
        <translation>点云视图中的点，用外参投影</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>适应窗口</translation>
    </message>
    <message>
        <source>Show the whole image (F)</source>
        <translation>显示整幅图像 (F)</translation>
    </message>
    <message>
        <source>One image pixel per screen pixel (1)</source>
        <translation>图像像素与屏幕像素一一对应 (1)</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>色阶</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黑场</translation>
    </message>
    <message>
        <source>Grey value shown as black (0 … 255 of full scale)</source>
        <translation>显示为黑色的灰度值（满量程 0 … 255）</translation>
    </message>
    <message>
        <source>White</source>
        <translation>白场</translation>
    </message>
    <message>
        <source>Grey value shown as white (0 … 255 of full scale)</source>
        <translation>显示为白色的灰度值（满量程 0 … 255）</translation>
    </message>
    <message>
        <source>Auto</source>
        <translation>自动</translation>
    </message>
    <message>
        <source>Levels that show the central 99 % of the pixels with most contrast</source>
        <translation>使中间 99 % 的像素对比度最大的色阶</translation>
    </message>
    <message>
        <source>Pixel under the cursor (x, y) and its grey value</source>
        <translation>光标处的像素 (x, y) 及其灰度值</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>未采用</translation>
    </message>
    <message>
        <source>LiDAR points on the board that are not used: refused by the program (red crosses), left out by hand (violet crosses)</source>
        <translation>标定板上未采用的激光雷达点：被程序拒绝的（红叉）、手动排除的（紫叉）</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a line about what is to be selected: the tags, circles and points that are shown. With Shift it is added to what is selected (L)</source>
        <translation>圈住要选中的内容：所显示的标签、圆和点。按住 Shift 则加入已选中的内容（L）</translation>
    </message>
    <message>
        <source>Board outline, circles and their centres as the LiDAR sees them, projected with the extrinsic (orange). Crossed out: not used</source>
        <translation>激光雷达所见的标定板轮廓、圆及其圆心，用外参投影（橙色）。打叉：未使用</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImageView</name>
    <message>
        <source>Image</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>Wheel: zoom. Drag: move. F: fit, 1: one to one. Click: nearest LiDAR points. Green: detected tags. Magenta arrows: corner residuals, enlarged (px). Orange: circles and outline from the LiDAR.</source>
        <translation>滚轮：缩放。拖动：平移。F：适应窗口，1：原始大小。单击：最近的激光点。绿色：检测到的标签。洋红箭头：放大的角点残差 (px)。橙色：激光雷达的圆和轮廓。</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>适应窗口</translation>
    </message>
    <message>
        <source>One to one</source>
        <translation>原始大小</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImportDialog</name>
    <message>
        <source>Looking for motion…</source>
        <translation>正在查找运动…</translation>
    </message>
    <message>
        <source>Reading…</source>
        <translation>正在读取…</translation>
    </message>
    <message>
        <source>Nothing stands still: something moves in images or clouds all the time.</source>
        <translation>没有静止时段：图像或点云中始终有物体在动。</translation>
    </message>
    <message>
        <source>Tick the stretches that are to become scenes.</source>
        <translation>请勾选要成为场景的时段。</translation>
    </message>
    <message>
        <source>%1 of %2 still stretches become scenes</source>
        <translation>%2 个静止时段中有 %1 个成为场景</translation>
    </message>
    <message>
        <source>New from a recording</source>
        <translation>从记录新建</translation>
    </message>
    <message>
        <source>%1 – %2, %3 s</source>
        <translation>%1 – %2，%3 s</translation>
    </message>
    <message>
        <source>&amp;Other recording…</source>
        <translation>其他记录(&amp;O)…</translation>
    </message>
    <message>
        <source>&amp;Edges of the stretch:</source>
        <translation>时段的边缘(&amp;E)：</translation>
    </message>
    <message>
        <source>&amp;As found</source>
        <translation>恢复原样(&amp;A)</translation>
    </message>
    <message>
        <source>The edges as they were found, where nothing moves in between</source>
        <translation>找到时的边缘，其间没有任何运动</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>What lies between the edges becomes the scene; they can be dragged on the time line as well</source>
        <translation>边缘之间的内容成为场景；也可以在时间线上拖动边缘</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImportFoot</name>
    <message>
        <source>%1 is written, without intrinsics: put a camera.yaml into it, then open it.</source>
        <translation>已写入 %1，但没有内参：请放入 camera.yaml，然后打开。</translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation>重新查看(&amp;L)</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>停止(&amp;S)</translation>
    </message>
    <message>
        <source>Import and &amp;calibrate</source>
        <translation>导入并标定(&amp;C)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ImportForm</name>
    <message>
        <source>CameraInfo %1</source>
        <translation>CameraInfo %1</translation>
    </message>
    <message>
        <source>none yet</source>
        <translation>暂无</translation>
    </message>
    <message>
        <source>Choose a camera file…</source>
        <translation>选择相机文件…</translation>
    </message>
    <message>
        <source>Choose a folder for the dataset.</source>
        <translation>请为数据集选择文件夹。</translation>
    </message>
    <message>
        <source>&amp;Images:</source>
        <translation>图像(&amp;I)：</translation>
    </message>
    <message>
        <source>C&amp;louds:</source>
        <translation>点云(&amp;L)：</translation>
    </message>
    <message>
        <source>I&amp;ntrinsics:</source>
        <translation>内参(&amp;N)：</translation>
    </message>
    <message>
        <source>&amp;Board:</source>
        <translation>标定板(&amp;B)：</translation>
    </message>
    <message>
        <source>Shortest &amp;stretch:</source>
        <translation>最短时段(&amp;S)：</translation>
    </message>
    <message>
        <source>&amp;Dataset folder:</source>
        <translation>数据集文件夹(&amp;D)：</translation>
    </message>
    <message>
        <source>B&amp;rowse…</source>
        <translation>浏览(&amp;R)…</translation>
    </message>
    <message>
        <source>Re&amp;place the earlier import</source>
        <translation>替换先前的导入(&amp;P)</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Stretches in which everything stands still for less give no scene</source>
        <translation>静止时间更短的时段不成为场景</translation>
    </message>
    <message>
        <source>CameraInfo of the recording, or a camera.yaml</source>
        <translation>记录中的 CameraInfo，或 camera.yaml</translation>
    </message>
    <message>
        <source>Make a camera.yaml…</source>
        <translation>新建 camera.yaml…</translation>
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
        <source>&amp;Undo: %1</source>
        <translation>撤销(&amp;U)：%1</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>撤销(&amp;U)</translation>
    </message>
    <message>
        <source>&amp;Redo: %1</source>
        <translation>重做(&amp;R)：%1</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>重做(&amp;R)</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>撤销</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>重做</translation>
    </message>
    <message>
        <source>Repor&amp;t…</source>
        <translation>报告(&amp;T)…</translation>
    </message>
    <message>
        <source>Write the result as one HTML file with its figures</source>
        <translation>将结果连同图表写成一个 HTML 文件</translation>
    </message>
    <message>
        <source>Simulate four scenes and open them, with a guided tour</source>
        <translation>模拟四个场景并打开，附带导览</translation>
    </message>
    <message>
        <source>&amp;New from recording…</source>
        <translation>从记录新建(&amp;N)…</translation>
    </message>
    <message>
        <source>Make a dataset of a ROS bag, rosbag2 or MCAP, and calibrate it</source>
        <translation>由 ROS bag、rosbag2 或 MCAP 记录生成数据集并标定</translation>
    </message>
    <message>
        <source>&amp;Tools</source>
        <translation>工具(&amp;T)</translation>
    </message>
    <message>
        <source>&amp;Correct clouds…</source>
        <translation>校正点云(&amp;C)…</translation>
    </message>
    <message>
        <source>Take the effects of the model in force out of clouds of this LiDAR</source>
        <translation>从此激光雷达的点云中去除当前模型的效应</translation>
    </message>
    <message>
        <source>Compare &amp;with…</source>
        <translation>比较(&amp;W)…</translation>
    </message>
    <message>
        <source>&amp;Print the board…</source>
        <translation>打印标定板(&amp;P)…</translation>
    </message>
    <message>
        <source>Draw the board for printing, exactly to scale</source>
        <translation>按精确比例绘制标定板以供打印</translation>
    </message>
    <message>
        <source>New from &amp;files…</source>
        <translation>从文件新建(&amp;F)…</translation>
    </message>
    <message>
        <source>Make a dataset of images and clouds that lie in folders, and calibrate it</source>
        <translation>用文件夹中的图像和点云生成数据集并标定</translation>
    </message>
    <message>
        <source>&amp;Target and camera…</source>
        <translation>标定板与相机(&amp;T)…</translation>
    </message>
    <message>
        <source>Make or edit target.yaml and camera.yaml</source>
        <translation>新建或编辑 target.yaml 和 camera.yaml</translation>
    </message>
    <message>
        <source>The difference to another result, an earlier step, another project, or a truth</source>
        <translation>与另一结果、较早步骤、另一项目或真值的差异</translation>
    </message>
    <message>
        <source>&amp;Watch this folder</source>
        <translation>监视此文件夹(&amp;W)</translation>
    </message>
    <message>
        <source>New scene folders in this dataset become scenes and are solved at once</source>
        <translation>此数据集中新的场景文件夹会成为场景并立即求解</translation>
    </message>
    <message>
        <source>Watch a folder of &amp;images and clouds…</source>
        <translation>监视图像与点云文件夹(&amp;I)…</translation>
    </message>
    <message>
        <source>What another program writes there becomes scenes of the dataset that is open, or of a new one</source>
        <translation>其他程序写入其中的内容会成为已打开数据集或新数据集的场景</translation>
    </message>
    <message>
        <source>What &amp;next</source>
        <translation>下一步(&amp;N)</translation>
    </message>
    <message>
        <source>The last scene and the next pose, large enough to be read from two metres away</source>
        <translation>最近的场景与下一个位姿，字大到两米外可读</translation>
    </message>
    <message>
        <source>Plan &amp;scenes…</source>
        <translation>规划场景(&amp;S)…</translation>
    </message>
    <message>
        <source>Where to hold the board, before it is taken out: for the board, camera and LiDAR that are open or chosen</source>
        <translation>在拿出标定板之前就知道该放在哪里：用于已打开或所选的标定板、相机与激光雷达</translation>
    </message>
    <message>
        <source>C&amp;heck on fresh data…</source>
        <translation>用新数据检验(&amp;H)…</translation>
    </message>
    <message>
        <source>Lay the pose over images and clouds, with or without a board, and see whether their edges agree; find a rough pose by hand</source>
        <translation>把位姿叠加到有无标定板的图像和点云上，看边缘是否吻合；或手动寻找粗略位姿</translation>
    </message>
    <message>
        <source>Calibrate a c&amp;amera…</source>
        <translation>标定相机(&amp;A)…</translation>
    </message>
    <message>
        <source>A camera alone, from a folder of images of the board; no dataset is needed</source>
        <translation>仅标定相机：使用标定板图像文件夹，无需数据集</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::MainWindow</name>
    <message>
        <source>LV-Calib Workbench</source>
        <translation>LV-Calib 工作台</translation>
    </message>
    <message>
        <source>Scene %1: %2</source>
        <translation>场景 %1：%2</translation>
    </message>
    <message>
        <source>%1 s to %2 s</source>
        <translation>%1 s 到 %2 s</translation>
    </message>
    <message>
        <source>%1: scene %2</source>
        <translation>%1：场景 %2</translation>
    </message>
    <message>
        <source>%1: left: %2</source>
        <translation>%1：略去：%2</translation>
    </message>
    <message>
        <source>Imported into %1: %2 of %3 still stretches are scenes.</source>
        <translation>已导入到 %1：%3 个静止时段中有 %2 个是场景。</translation>
    </message>
    <message>
        <source>The distance to the truth is shown on the Model page: %1</source>
        <translation>与真值的距离显示在“模型”页：%1</translation>
    </message>
    <message>
        <source>Imported into %1: %2 of %3 pairs are scenes.</source>
        <translation>已导入 %1：%3 对中有 %2 对是场景。</translation>
    </message>
    <message>
        <source>Watching %1.</source>
        <translation>正在监视 %1。</translation>
    </message>
    <message>
        <source>Watching has ended.</source>
        <translation>监视已结束。</translation>
    </message>
    <message>
        <source>Several at once are added as scenes to what is open, and nothing is open yet: drop one folder, project or recording first.</source>
        <translation>一次放下多个时，会作为场景加入已打开的数据集，而现在尚未打开任何内容：请先放下一个文件夹、项目或录制文件。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::MethodsPane</name>
    <message>
        <source>Joint, as in the paper</source>
        <translation>联合，按论文原文</translation>
    </message>
    <message>
        <source>3D-SVD</source>
        <translation>3D-SVD</translation>
    </message>
    <message>
        <source>W-SVD</source>
        <translation>W-SVD</translation>
    </message>
    <message>
        <source>PnP</source>
        <translation>PnP</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>联合</translation>
    </message>
    <message>
        <source>%1, raw</source>
        <translation>%1，原始</translation>
    </message>
    <message>
        <source>%1, refined</source>
        <translation>%1，精化</translation>
    </message>
    <message>
        <source>Method, centres</source>
        <translation>方法，圆心</translation>
    </message>
    <message>
        <source>corners (px)</source>
        <translation>角点 (px)</translation>
    </message>
    <message>
        <source>nodes (mm)</source>
        <translation>节点 (mm)</translation>
    </message>
    <message>
        <source>transfer (px)</source>
        <translation>传递 (px)</translation>
    </message>
    <message>
        <source>held out (px)</source>
        <translation>留出 (px)</translation>
    </message>
    <message>
        <source>held out (mm)</source>
        <translation>留出 (mm)</translation>
    </message>
    <message>
        <source>How the extrinsic is found, and from which circle centres: as initialised (raw) or as refined</source>
        <translation>外参的求法，以及所用的圆心：初始（原始）或精化</translation>
    </message>
    <message>
        <source>Root mean square of the corners&apos; reprojection residuals</source>
        <translation>角点重投影残差的均方根</translation>
    </message>
    <message>
        <source>Root mean square of the residuals of the refined nodes</source>
        <translation>精化节点残差的均方根</translation>
    </message>
    <message>
        <source>Corners predicted from the LiDAR alone against the corners found: an extrinsic&apos;s error undiminished by the board poses</source>
        <translation>仅由激光雷达预测的角点与检测角点之差：未被标定板位姿吸收的外参误差</translation>
    </message>
    <message>
        <source>Corners of scenes that the method has not seen</source>
        <translation>该方法未使用的场景的角点</translation>
    </message>
    <message>
        <source>Nodes of scenes that the method has not seen</source>
        <translation>该方法未使用的场景的节点</translation>
    </message>
    <message>
        <source>Methods side by side</source>
        <translation>各方法对比</translation>
    </message>
    <message>
        <source>corner residual (px)</source>
        <translation>角点残差 (px)</translation>
    </message>
    <message>
        <source>node residual (mm)</source>
        <translation>节点残差 (mm)</translation>
    </message>
    <message>
        <source>What each method leaves at the corners (px): median, quartiles, whiskers to 1.5 box lengths, circles beyond</source>
        <translation>各方法在角点上的残差 (px)：中位数、四分位数、须线至 1.5 倍箱长，圆圈为更远者</translation>
    </message>
    <message>
        <source>What each method leaves at the refined nodes (mm): median, quartiles, whiskers to 1.5 box lengths, circles beyond</source>
        <translation>各方法在精化节点上的残差 (mm)：中位数、四分位数、须线至 1.5 倍箱长，圆圈为更远者</translation>
    </message>
    <message>
        <source>Run the calibration to compare the methods.</source>
        <translation>运行标定后可比较各方法。</translation>
    </message>
    <message>
        <source>There is no extrinsic to compare.</source>
        <translation>没有可比较的外参。</translation>
    </message>
    <message>
        <source>This board has no circles: there are no nodes for the other methods.</source>
        <translation>该标定板没有圆：其他方法没有节点可用。</translation>
    </message>
    <message>
        <source>Not enough scenes for held-out residuals: two are needed.</source>
        <translation>场景不足以计算留出残差：需要两个。</translation>
    </message>
    <message>
        <source>Every return</source>
        <translation>全部回波</translation>
    </message>
    <message>
        <source>All methods measured alike; scenes: %1.</source>
        <translation>所有方法以同样方式度量；场景数：%1。</translation>
    </message>
    <message>
        <source>from result (mm)</source>
        <translation>距结果 (mm)</translation>
    </message>
    <message>
        <source>from result (mrad)</source>
        <translation>距结果 (mrad)</translation>
    </message>
    <message>
        <source>Distance of the LiDAR&apos;s origin to where the result has it</source>
        <translation>激光雷达原点与结果中其位置的距离</translation>
    </message>
    <message>
        <source>Rotation against the result</source>
        <translation>相对于结果的转动</translation>
    </message>
    <message>
        <source>Bold: the result.</source>
        <translation>粗体：即所给结果。</translation>
    </message>
    <message>
        <source>The result is of another model, %1, which is not among them.</source>
        <translation>结果来自另一个模型（%1），不在其中。</translation>
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
        <translation>&lt;b&gt;遗漏了%1。&lt;/b&gt;</translation>
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
    <message>
        <source>Upper 95 % limit of its largest parameter; beyond it these scenes would show it</source>
        <translation>其最大参数的 95 % 上限；超过它这些场景就会显示出来</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>遗漏</translation>
    </message>
    <message>
        <source>Cannot be seen</source>
        <translation>看不到的</translation>
    </message>
    <message>
        <source>if %1</source>
        <translation>若 %1</translation>
    </message>
    <message>
        <source>Predicted fall of the squared error in scenes held out, where it helps most</source>
        <translation>在其作用最大的通道中，留出场景平方误差的预计降幅</translation>
    </message>
    <message>
        <source>Others may only stand in for it: they are judged again once it is added.</source>
        <translation>其他效应可能只是它的替代：加入它之后会重新判断。</translation>
    </message>
    <message>
        <source>No further scene is asked for.</source>
        <translation>不需要更多场景。</translation>
    </message>
    <message>
        <source>&lt;b&gt;Nothing that matters is missing.&lt;/b&gt; Structure is left that no known effect explains, too small to move the extrinsic.</source>
        <translation>&lt;b&gt;不缺任何有影响的效应。&lt;/b&gt;仍有已知效应无法解释的结构，但小到不会移动外参。</translation>
    </message>
    <message>
        <source>Next scenes</source>
        <translation>下一步场景</translation>
    </message>
    <message>
        <source>Scenes that would tell what these cannot, and what else would</source>
        <translation>能说明这些场景无法说明之处的场景，以及其他办法</translation>
    </message>
    <message>
        <source>Effects that these scenes do not show, and by how much each could move the extrinsic all the same</source>
        <translation>这些场景看不出的效应，以及每个效应仍可能使外参移动多少</translation>
    </message>
    <message>
        <source>add a curve</source>
        <translation>添加曲线</translation>
    </message>
    <message>
        <source>add %1</source>
        <translation>添加 %1</translation>
    </message>
    <message>
        <source>&lt;b&gt;No effect is found to be missing.&lt;/b&gt; The result is doubtful all the same: %1</source>
        <translation>&lt;b&gt;未发现遗漏的效应。&lt;/b&gt;但结果仍然存疑：%1</translation>
    </message>
    <message>
        <source>A closed form predicts as well:</source>
        <translation>有一个闭式公式预测得同样好：</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ModelPage</name>
    <message>
        <source>Run the calibration to see what its model explains and what it misses.</source>
        <translation>运行标定，查看模型解释了什么、遗漏了什么。</translation>
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
    <message>
        <source>within noise</source>
        <translation>噪声以内</translation>
    </message>
    <message>
        <source>Compare steps…</source>
        <translation>比较步骤…</translation>
    </message>
    <message>
        <source>How far the pose moved between two steps, and the residuals of every scene at both</source>
        <translation>两步之间位姿移动了多少，以及各场景在两步的残差</translation>
    </message>
    <message>
        <source>The measurements are being collected and the model fitted …</source>
        <translation>正在收集测量值并拟合模型……</translation>
    </message>
    <message>
        <source>mm from the truth</source>
        <translation>与真值相差 mm</translation>
    </message>
    <message>
        <source>mrad from the truth</source>
        <translation>与真值相差 mrad</translation>
    </message>
    <message>
        <source>The model is not fitted to this calibration yet: press Look again.</source>
        <translation>模型尚未对此标定进行拟合：请按“重新查找”。</translation>
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
    <message>
        <source>Model: %1</source>
        <translation>模型：%1</translation>
    </message>
    <message>
        <source>Model: going to another step</source>
        <translation>模型：转到另一步</translation>
    </message>
    <message>
        <source>Model: fitted again, as the calibration is another</source>
        <translation>模型：标定已变，重新拟合</translation>
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
        <source>Boundary response</source>
        <translation>边界响应</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>模型</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
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
        <source>Clouds</source>
        <translation>点云</translation>
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
    <message>
        <source>Boundary response</source>
        <translation>边界响应</translation>
    </message>
    <message>
        <source>Missing effects</source>
        <translation>缺失的效应</translation>
    </message>
    <message>
        <source>Every return</source>
        <translation>全部回波</translation>
    </message>
    <message>
        <source>Intrinsics</source>
        <translation>内参</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PlanDialog</name>
    <message>
        <source>Cancelled</source>
        <translation>已取消</translation>
    </message>
    <message>
        <source>that of the scenes taken</source>
        <translation>已拍场景所用的</translation>
    </message>
    <message>
        <source>Choose a description…</source>
        <translation>选择描述文件…</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>倾角</translation>
    </message>
    <message>
        <source>σ position</source>
        <translation>σ 位置</translation>
    </message>
    <message>
        <source>σ rotation</source>
        <translation>σ 旋转</translation>
    </message>
    <message>
        <source>Of the extrinsic&apos;s position once the scene is taken: root of the sum over three axes, from the measurements&apos; noise alone</source>
        <translation>拍完该场景后外参位置的标准差：三轴方差和的平方根，仅计测量噪声</translation>
    </message>
    <message>
        <source>Of the extrinsic&apos;s rotation once the scene is taken: root of the sum over three axes, from the measurements&apos; noise alone</source>
        <translation>拍完该场景后外参旋转的标准差：三轴方差和的平方根，仅计测量噪声</translation>
    </message>
    <message>
        <source>By how many σ its size of interest stands above zero</source>
        <translation>其关注大小比零高多少个 σ</translation>
    </message>
    <message>
        <source>the scenes taken</source>
        <translation>已拍的场景</translation>
    </message>
    <message>
        <source>Scene %1: %2</source>
        <translation>场景 %1：%2</translation>
    </message>
    <message>
        <source>The board as the camera will see it:</source>
        <translation>相机将看到的标定板：</translation>
    </message>
    <message>
        <source>Choose the description of the board (target.yaml).</source>
        <translation>请选择标定板描述文件 (target.yaml)。</translation>
    </message>
    <message>
        <source>Choose the intrinsics of the camera (camera.yaml).</source>
        <translation>请选择相机内参文件 (camera.yaml)。</translation>
    </message>
    <message>
        <source>of what is open</source>
        <translation>已打开的</translation>
    </message>
    <message>
        <source>none yet</source>
        <translation>暂无</translation>
    </message>
    <message>
        <source>.</source>
        <translation>。</translation>
    </message>
    <message>
        <source>Plans where to hold the board: each scene is the one that tells most about the extrinsic after those before it.</source>
        <translation>规划标定板的摆放：每个场景都是在之前场景的基础上对外参信息最多的一个。</translation>
    </message>
    <message>
        <source>; then σ %1, %2</source>
        <translation>；此后 σ %1，%2</translation>
    </message>
    <message>
        <source>Copied.</source>
        <translation>已复制。</translation>
    </message>
    <message>
        <source>Plan (*.json)</source>
        <translation>规划 (*.json)</translation>
    </message>
    <message>
        <source>Written to %1.</source>
        <translation>已写入 %1。</translation>
    </message>
    <message>
        <source>Plan scenes</source>
        <translation>规划场景</translation>
    </message>
    <message>
        <source>Board:</source>
        <translation>标定板：</translation>
    </message>
    <message>
        <source>Camera:</source>
        <translation>相机：</translation>
    </message>
    <message>
        <source>&amp;LiDAR:</source>
        <translation>激光雷达(&amp;L)：</translation>
    </message>
    <message>
        <source>&amp;Scenes:</source>
        <translation>场景数(&amp;S)：</translation>
    </message>
    <message>
        <source>Ch&amp;oose…</source>
        <translation>选择(&amp;O)…</translation>
    </message>
    <message>
        <source>The target.yaml of another board</source>
        <translation>另一块标定板的 target.yaml</translation>
    </message>
    <message>
        <source>C&amp;hoose…</source>
        <translation>选择(&amp;H)…</translation>
    </message>
    <message>
        <source>The camera.yaml of another camera</source>
        <translation>另一台相机的 camera.yaml</translation>
    </message>
    <message>
        <source>Field of view, density and noise; rough T_camera_lidar where the description has one, else x forward, y left, z up at the camera</source>
        <translation>视场、密度与噪声；若描述中有则用其粗略的 T_camera_lidar，否则取 x 向前、y 向左、z 向上，位于相机处</translation>
    </message>
    <message>
        <source>&amp;Go on from the scenes taken</source>
        <translation>从已拍的场景继续(&amp;G)</translation>
    </message>
    <message>
        <source>Begin with what the present result knows of the extrinsic, instead of with nothing</source>
        <translation>从当前结果对外参的了解开始，而不是从零开始</translation>
    </message>
    <message>
        <source>Effects to become &amp;testable:</source>
        <translation>要变得可检验的效应(&amp;T)：</translation>
    </message>
    <message>
        <source>&amp;Plan</source>
        <translation>规划(&amp;P)</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>取消(&amp;C)</translation>
    </message>
    <message>
        <source>Sa&amp;ve plan.json…</source>
        <translation>保存 plan.json(&amp;V)…</translation>
    </message>
    <message>
        <source>Cop&amp;y as text</source>
        <translation>复制为文本(&amp;Y)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>top</source>
        <translation>上</translation>
    </message>
    <message>
        <source>The board as the camera will see it, its upper edge marked</source>
        <translation>相机将看到的标定板，标出其上边</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>Chosen one after the other from %1 poses that camera and LiDAR both see. σ is by noise alone.</source>
        <translation>从相机与激光雷达都能看到的 %1 个位姿中逐个选出。σ 仅由噪声引起。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PlanWork</name>
    <message>
        <source>the scenes do not tell enough of the LiDAR: the joint solve over every return failed</source>
        <translation>这些场景不足以说明激光雷达：对所有回波的联合求解失败</translation>
    </message>
    <message>
        <source>choose a description of the LiDAR</source>
        <translation>请选择激光雷达描述文件</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PlotView</name>
    <message>
        <source>Show everything</source>
        <translation>显示全部</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::PrintDialog</name>
    <message>
        <source>PDF (*.pdf);;SVG (*.svg);;PNG (*.png)</source>
        <translation>PDF (*.pdf);;SVG (*.svg);;PNG (*.png)</translation>
    </message>
    <message>
        <source>Board of %1 × %2 mm; pages: %3. Print without scaling (100 %) and measure the scale bar.</source>
        <translation>标定板 %1 × %2 mm；页数：%3。请不缩放打印（100 %），并测量比例尺。</translation>
    </message>
    <message>
        <source>Written: %1</source>
        <translation>已写入：%1</translation>
    </message>
    <message>
        <source>Print the board</source>
        <translation>打印标定板</translation>
    </message>
    <message>
        <source>&amp;Board:</source>
        <translation>标定板(&amp;B)：</translation>
    </message>
    <message>
        <source>&amp;Paper:</source>
        <translation>纸张(&amp;P)：</translation>
    </message>
    <message>
        <source>&amp;File:</source>
        <translation>文件(&amp;F)：</translation>
    </message>
    <message>
        <source>P&amp;lace…</source>
        <translation>位置(&amp;L)…</translation>
    </message>
    <message>
        <source>&amp;Write</source>
        <translation>写入(&amp;W)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>of the open dataset</source>
        <translation>当前数据集的标定板</translation>
    </message>
    <message>
        <source>Standard board: 4 × 4 tags with circles</source>
        <translation>标准标定板：4 × 4 标签，带圆</translation>
    </message>
    <message>
        <source>Choose a target.yaml…</source>
        <translation>选择 target.yaml…</translation>
    </message>
    <message>
        <source>one page of the board&apos;s size</source>
        <translation>一页，大小同标定板</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::RangePlot</name>
    <message>
        <source>range off the board&apos;s plane (mm)</source>
        <translation>偏离标定板平面的距离 (mm)</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>样本数</translation>
    </message>
    <message>
        <source>Ranges of the samples of the overlap region, less the range of the board&apos;s plane along the same ray, in classes of 2 mm. Lines: one standard deviation of the range of a beam on the edge.</source>
        <translation>重叠区样本的距离减去同一光线上标定板平面的距离，每组 2 mm。竖线：边缘上光束距离的一倍标准差。</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>σ range %1 mm</source>
        <translation>距离 σ %1 mm</translation>
    </message>
    <message>
        <source>±1σ of a beam</source>
        <translation>光束的 ±1σ</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::RefinementPage</name>
    <message>
        <source>Choose a scene and run the calibration to see its refinement.</source>
        <translation>选择一个场景并运行标定，即可查看其精化过程。</translation>
    </message>
    <message>
        <source>Angle (°)</source>
        <translation>角度 (°)</translation>
    </message>
    <message>
        <source>Midpoint (mm)</source>
        <translation>中点 (mm)</translation>
    </message>
    <message>
        <source>σ (mm)</source>
        <translation>σ (mm)</translation>
    </message>
    <message>
        <source>Samples</source>
        <translation>样本数</translation>
    </message>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Angular bins of the chosen node</source>
        <translation>所选节点的角度区间</translation>
    </message>
    <message>
        <source>Every angular bin of the chosen node: where the intensity crosses its middle level (mm from the circle), its standard deviation, and why it was refused</source>
        <translation>所选节点的每个角度区间：强度穿过中间值的位置（到圆的距离，mm）、其标准差以及被拒绝的原因</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>回放</translation>
    </message>
    <message>
        <source>Iteration shown</source>
        <translation>显示的迭代</translation>
    </message>
    <message>
        <source>Iteration</source>
        <translation>迭代</translation>
    </message>
    <message>
        <source>This scene was not refined.</source>
        <translation>该场景未精化。</translation>
    </message>
    <message>
        <source>This scene was not refined: %1</source>
        <translation>该场景未精化：%1</translation>
    </message>
    <message>
        <source>This board has no circles: there is nothing to refine.</source>
        <translation>该标定板没有圆：无需精化。</translation>
    </message>
    <message>
        <source>node %1</source>
        <translation>节点 %1</translation>
    </message>
    <message>
        <source>node %1: not usable</source>
        <translation>节点 %1：不可用</translation>
    </message>
    <message>
        <source>node %1: |Δc| %2 mm</source>
        <translation>节点 %1：|Δc| %2 mm</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>iteration %1 of %2, largest move %3 mm</source>
        <translation>第 %1/%2 次迭代，最大移动 %3 mm</translation>
    </message>
    <message>
        <source>%1 of %2 bins used</source>
        <translation>使用 %1/%2 个区间</translation>
    </message>
    <message>
        <source>; Δcu %1, Δcv %2, Δr %3 mm</source>
        <translation>；Δcu %1，Δcv %2，Δr %3 mm</translation>
    </message>
    <message>
        <source>; levels %1 and %2</source>
        <translation>；强度 %1 和 %2</translation>
    </message>
    <message>
        <source>; not usable: %1</source>
        <translation>；不可用：%1</translation>
    </message>
    <message>
        <source>%1: %2 mm</source>
        <translation>%1：%2 mm</translation>
    </message>
    <message>
        <source>%1: not usable</source>
        <translation>%1：不可用</translation>
    </message>
    <message>
        <source>left out by hand</source>
        <translation>手动剔除</translation>
    </message>
    <message>
        <source>%1: left out</source>
        <translation>%1：未采用</translation>
    </message>
    <message>
        <source>Left out: %1.</source>
        <translation>未采用：%1。</translation>
    </message>
    <message>
        <source>Use it all the same</source>
        <translation>仍然采用</translation>
    </message>
    <message>
        <source>Replay the iterations from the first (P)</source>
        <translation>从第一次开始重放迭代 (P)</translation>
    </message>
    <message>
        <source>Exclude these bins</source>
        <translation>排除这些角度区间</translation>
    </message>
    <message>
        <source>Leave out the returns in the selected angular bins of this circle, and solve again</source>
        <translation>舍去此圆所选角度区间内的回波，并重新求解</translation>
    </message>
    <message>
        <source>Exclude this circle</source>
        <translation>排除此圆</translation>
    </message>
    <message>
        <source>Leave out this circle in this scene, and solve again</source>
        <translation>在此场景中舍去此圆，并重新求解</translation>
    </message>
    <message>
        <source>Take back</source>
        <translation>恢复</translation>
    </message>
    <message>
        <source>Use again what was left out of this circle by hand</source>
        <translation>重新使用此圆中手动舍去的部分</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a rectangle over samples in the large figure to select their bins. With Shift they are added to those selected (L)</source>
        <translation>在大图的样本上画一个矩形，以选择其角度区间。按住 Shift 则加入已选的区间 (L)</translation>
    </message>
    <message>
        <source>node %1: left out by hand</source>
        <translation>节点 %1：手动剔除</translation>
    </message>
    <message>
        <source>; left out by hand: %1</source>
        <translation>；手动剔除 %1 个</translation>
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
        <translation>平均残差 (%1)</translation>
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
        <translation>残差 (%1)</translation>
    </message>
    <message>
        <source>residuals</source>
        <translation>残差</translation>
    </message>
    <message>
        <source>noise of one</source>
        <translation>单个残差的噪声</translation>
    </message>
    <message>
        <source>means ± 2σ</source>
        <translation>均值 ± 2σ</translation>
    </message>
    <message>
        <source>differ from zero</source>
        <translation>显著非零</translation>
    </message>
    <message>
        <source>selected</source>
        <translation>已选中</translation>
    </message>
    <message>
        <source>base model</source>
        <translation>基础模型</translation>
    </message>
    <message>
        <source>chosen effect</source>
        <translation>所选效应</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResponsePage</name>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Range, incidence</source>
        <translation>距离，入射角</translation>
    </message>
    <message>
        <source>Boundary response per scene</source>
        <translation>各场景的边界响应</translation>
    </message>
    <message>
        <source>Scenes</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>By range and incidence</source>
        <translation>按距离和入射角</translation>
    </message>
    <message>
        <source>Run the calibration to see how returns scatter at the circles&apos; edges.</source>
        <translation>运行标定后可查看回波在圆边缘处的散布。</translation>
    </message>
    <message>
        <source>All scenes</source>
        <translation>全部场景</translation>
    </message>
    <message>
        <source>%1–%2 m, %3–%4°</source>
        <translation>%1–%2 m，%3–%4°</translation>
    </message>
    <message>
        <source>not enough samples: %1</source>
        <translation>样本不足：%1</translation>
    </message>
    <message>
        <source>Scene %1:</source>
        <translation>场景 %1：</translation>
    </message>
    <message>
        <source>Scene %1, circle %2:</source>
        <translation>场景 %1，圆 %2：</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>未采用</translation>
    </message>
    <message>
        <source>Scene %1, corners of tag %2:</source>
        <translation>场景 %1，标签 %2 的角点：</translation>
    </message>
    <message numerus="yes">
        <source>Scene %1, %n points on the board:</source>
        <translation>
            <numerusform>场景 %1，板上 %n 个点：</numerusform>
        </translation>
    </message>
    <message>
        <source>Scene %1, for the boundary response alone:</source>
        <translation>场景 %1，仅就边界响应而言：</translation>
    </message>
    <message>
        <source>Scene %1, circle %2, for the boundary response alone:</source>
        <translation>场景 %1，圆 %2，仅就边界响应而言：</translation>
    </message>
    <message>
        <source>Use it all the same</source>
        <translation>仍然采用</translation>
    </message>
    <message>
        <source>Nothing: everything found is used.</source>
        <translation>无：找到的全部采用。</translation>
    </message>
    <message numerus="yes">
        <source>Scene %1, %n points at x %2 to %3 m, y %4 to %5 m on the board:</source>
        <translation>
            <numerusform>场景 %1，标定板上 x %2 至 %3 m、y %4 至 %5 m 处的 %n 个点：</numerusform>
        </translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>刷选</translation>
    </message>
    <message>
        <source>Draw a rectangle over the samples on the board: returns there can be left out, of the scene chosen in the table or of all</source>
        <translation>在标定板上的样本处框选一个矩形：可将其中的回波从表中所选场景或全部场景中排除</translation>
    </message>
    <message>
        <source>Exclude this part of the board in every scene</source>
        <translation>在所有场景中排除标定板的这一部分</translation>
    </message>
    <message>
        <source>Exclude this part of the board in scene %1</source>
        <translation>在场景 %1 中排除标定板的这一部分</translation>
    </message>
    <message>
        <source>Leave it out again</source>
        <translation>重新排除</translation>
    </message>
    <message>
        <source>left out by hand</source>
        <translation>手动剔除</translation>
    </message>
    <message>
        <source>Take back</source>
        <translation>恢复</translation>
    </message>
    <message>
        <source>Scene %1, part of the board at x %2 to %3 m, y %4 to %5 m:</source>
        <translation>场景 %1，标定板上 x %2 至 %3 m、y %4 至 %5 m 的部分：</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ResultActions</name>
    <message>
        <source>Report written to %1.</source>
        <translation>报告已写入 %1。</translation>
    </message>
    <message>
        <source>Report written to %1</source>
        <translation>报告已写入 %1</translation>
    </message>
    <message>
        <source>Report cancelled</source>
        <translation>报告已取消</translation>
    </message>
    <message>
        <source>The report could not be written</source>
        <translation>无法写入报告</translation>
    </message>
    <message>
        <source>Exported %1.</source>
        <translation>已导出 %1。</translation>
    </message>
    <message>
        <source>Exported %1</source>
        <translation>已导出 %1</translation>
    </message>
    <message>
        <source>HTML (*.html)</source>
        <translation>HTML (*.html)</translation>
    </message>
    <message>
        <source>Written: %1. What is open was read before; open it again to use this file.</source>
        <translation>已写入：%1。当前打开的数据是之前读取的；请重新打开以使用此文件。</translation>
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
        <translation>将点从激光雷达坐标系变换到相机坐标系（x 向右、y 向下、z 向前）；长度单位为米</translation>
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
    <message>
        <source>Pose</source>
        <translation>位姿</translation>
    </message>
    <message>
        <source>For other tools</source>
        <translation>供其他工具使用</translation>
    </message>
    <message>
        <source>± in total</source>
        <translation>± 总计</translation>
    </message>
    <message>
        <source>Model:</source>
        <translation>模型：</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::SampleMapPlot</name>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>样本</translation>
    </message>
    <message>
        <source>overlap region</source>
        <translation>重叠区</translation>
    </message>
    <message>
        <source>circles left out</source>
        <translation>未使用的圆</translation>
    </message>
    <message>
        <source>covered</source>
        <translation>被遮挡</translation>
    </message>
    <message>
        <source>The board from the front with the returns about its circles (of many, some), blue those of the overlap region. Dashed red: circles that are left out in one of the scenes shown; hatched: where something seems to cover the board; violet: what is left out by hand. The reasons are in the table below.</source>
        <translation>标定板正面及圆周围的回波（过多时取一部分），蓝色为重叠区的回波。红色虚线：在所示某个场景中未采用的圆；斜线：标定板似乎被遮挡之处；紫色：手动剔除的内容。原因见下表。</translation>
    </message>
    <message>
        <source>left out by hand</source>
        <translation>手动剔除</translation>
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
    <message>
        <source>used all the same: %1</source>
        <translation>仍被采用：%1</translation>
    </message>
    <message>
        <source>Left out: how it fits what the other scenes give.</source>
        <translation>未采用：它与其他场景所得结果的符合程度。</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>Your own words about the scene; kept in the project.</source>
        <translation>您对该场景的备注；保存在项目中。</translation>
    </message>
    <message>
        <source>not run</source>
        <translation>尚未运行</translation>
    </message>
    <message>
        <source>%1/%2</source>
        <translation>%1/%2</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>缺失</translation>
    </message>
    <message>
        <source>unreadable</source>
        <translation>无法读取</translation>
    </message>
    <message>
        <source>refused</source>
        <translation>被拒绝</translation>
    </message>
    <message>
        <source>Tags found in the image; 13/16: the program uses 13 of 16.</source>
        <translation>图像中找到的标签；13/16：程序使用 16 个中的 13 个。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ScenePage</name>
    <message>
        <source>Choose a scene in the list.</source>
        <translation>请在列表中选择一个场景。</translation>
    </message>
    <message>
        <source>The image is being loaded …</source>
        <translation>正在载入图像…</translation>
    </message>
    <message>
        <source>Point %1: x %2, y %3, z %4 m, range %5 m</source>
        <translation>点 %1：x %2，y %3，z %4 m，距离 %5 m</translation>
    </message>
    <message>
        <source>, intensity %1</source>
        <translation>，强度 %1</translation>
    </message>
    <message>
        <source>, line %1</source>
        <translation>，线 %1</translation>
    </message>
    <message>
        <source>, time %1 ms</source>
        <translation>，时间 %1 ms</translation>
    </message>
    <message>
        <source>, %1 mm beyond the board&apos;s plane</source>
        <translation>，超出标定板平面 %1 mm</translation>
    </message>
    <message>
        <source>, pixel (%1, %2)</source>
        <translation>，像素 (%1, %2)</translation>
    </message>
    <message>
        <source>, not in the image</source>
        <translation>，不在图像内</translation>
    </message>
    <message>
        <source>Pixel (%1, %2)</source>
        <translation>像素 (%1, %2)</translation>
    </message>
    <message>
        <source>: no LiDAR point within %1 px</source>
        <translation>：%1 px 内没有激光点</translation>
    </message>
    <message>
        <source>. Nearest: %1</source>
        <translation>。最近：%1</translation>
    </message>
    <message>
        <source>: LiDAR points are linked once there is an extrinsic</source>
        <translation>：求得外参后可关联激光点</translation>
    </message>
    <message>
        <source>Tag %1</source>
        <translation>标签 %1</translation>
    </message>
    <message>
        <source>: corner residuals %1 px</source>
        <translation>：角点残差 %1 px</translation>
    </message>
    <message>
        <source>; LiDAR points on it: %1</source>
        <translation>；其上的激光点：%1</translation>
    </message>
    <message>
        <source>Click a point, a pixel or a tag to see its values in both views.</source>
        <translation>单击点、像素或标签，可在两个视图中查看其数值。</translation>
    </message>
    <message numerus="yes">
        <source>%n measurements selected on the Model page</source>
        <translation>
            <numerusform>模型页上选中了 %n 个测量值</numerusform>
        </translation>
    </message>
    <message>
        <source>There is no image: %1</source>
        <translation>没有图像：%1</translation>
    </message>
    <message>
        <source>This scene is left out:</source>
        <translation>此场景未被采用：</translation>
    </message>
    <message>
        <source>Use it all the same</source>
        <translation>仍然采用</translation>
    </message>
    <message>
        <source>%1 m from point %2, picked before: Δx %3, Δy %4, Δz %5 m</source>
        <translation>距先前所选点 %2 为 %1 m：Δx %3，Δy %4，Δz %5 m</translation>
    </message>
    <message>
        <source>Circle %1</source>
        <translation>圆 %1</translation>
    </message>
    <message>
        <source>, its centre known to %1 mm</source>
        <translation>，圆心精度 %1 mm</translation>
    </message>
    <message>
        <source>, left out: %1</source>
        <translation>，未采用：%1</translation>
    </message>
    <message>
        <source>As the program would have it</source>
        <translation>恢复程序的选择</translation>
    </message>
    <message>
        <source>None of these points is about the board: they play no part anyway.</source>
        <translation>这些点都不在标定板附近：它们本来就不参与计算。</translation>
    </message>
    <message numerus="yes">
        <source>%n points about the board</source>
        <translation>
            <numerusform>标定板附近的 %n 个点</numerusform>
        </translation>
    </message>
    <message>
        <source>Nothing is selected.</source>
        <translation>未选中任何内容。</translation>
    </message>
    <message>
        <source>Selected: %1</source>
        <translation>已选中：%1</translation>
    </message>
    <message>
        <source>, left out by hand</source>
        <translation>，手动排除</translation>
    </message>
    <message>
        <source>, used all the same</source>
        <translation>，仍然采用</translation>
    </message>
    <message>
        <source>Drawn in red. A click on one says why, and offers to use it all the same where that is possible.</source>
        <translation>以红色绘出。点击其中之一可查看原因，并在可能时仍然采用。</translation>
    </message>
    <message>
        <source>tag no. %1</source>
        <translation>标签（编号 %1）</translation>
    </message>
    <message>
        <source>circle no. %1</source>
        <translation>圆（编号 %1）</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message>
        <source>Part of the board, used all the same</source>
        <translation>标定板的一部分，仍然使用</translation>
    </message>
    <message numerus="yes">
        <source>Part of the board, %n points left out: %1</source>
        <translation>
            <numerusform>标定板的一部分，%n 个点未使用：%1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Part of the board, %n points left out by hand</source>
        <translation>
            <numerusform>标定板的一部分，手动剔除了 %n 个点</numerusform>
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
        <source>Use it all the same</source>
        <translation>仍然采用</translation>
    </message>
    <message>
        <source>Use the selected scenes although the program refused them</source>
        <translation>采用所选场景，尽管程序拒绝了它们</translation>
    </message>
    <message>
        <source>Note…</source>
        <translation>备注…</translation>
    </message>
    <message>
        <source>Write a note on the scene</source>
        <translation>为该场景写备注</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>上移</translation>
    </message>
    <message>
        <source>Move the selected scenes up in the list</source>
        <translation>在列表中上移所选场景</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>下移</translation>
    </message>
    <message>
        <source>Move the selected scenes down in the list</source>
        <translation>在列表中下移所选场景</translation>
    </message>
    <message>
        <source>Add scene folders from elsewhere, several at once</source>
        <translation>从别处添加场景文件夹，可一次添加多个</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::SelectionBar</name>
    <message>
        <source>Exclude these</source>
        <translation>排除所选</translation>
    </message>
    <message>
        <source>Leave out what is selected, and solve again</source>
        <translation>不采用所选内容并重新求解</translation>
    </message>
    <message>
        <source>Exclude this patch of the board</source>
        <translation>排除标定板的这一块</translation>
    </message>
    <message>
        <source>Leave out every return on the part of the board that holds the points</source>
        <translation>不采用标定板上包含这些点的区域内的全部回波</translation>
    </message>
    <message>
        <source>Exclude this patch of the board in every scene</source>
        <translation>在所有场景中排除标定板的这一块</translation>
    </message>
    <message>
        <source>For a stain, a screw or a bent corner: it is there always</source>
        <translation>用于污渍、螺钉或翘角：它在每个场景中都存在</translation>
    </message>
    <message>
        <source>Take back</source>
        <translation>恢复</translation>
    </message>
    <message>
        <source>Use again what was left out of the selection by hand</source>
        <translation>重新采用所选内容中手动排除的部分</translation>
    </message>
    <message>
        <source>Use it all the same</source>
        <translation>仍然采用</translation>
    </message>
    <message>
        <source>Use the selected tags and circles although they miss the board&apos;s pose by more than the gate, and the parts of the board with the selected points although something seems to cover them</source>
        <translation>即使所选标签和圆偏离标定板位姿超过门限，也仍然采用；所选点所在的标定板部分即使看似被遮盖，也仍然采用</translation>
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
        <source>Writing the report</source>
        <translation>写报告</translation>
    </message>
    <message>
        <source>Fitting the model</source>
        <translation>拟合模型</translation>
    </message>
    <message>
        <source>Correcting</source>
        <translation>校正</translation>
    </message>
    <message>
        <source>Looking for structure</source>
        <translation>查找结构</translation>
    </message>
    <message>
        <source>Trying effects</source>
        <translation>尝试效应</translation>
    </message>
    <message>
        <source>Looking for advice</source>
        <translation>查找建议</translation>
    </message>
    <message>
        <source>Planning</source>
        <translation>规划</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>检查</translation>
    </message>
    <message>
        <source>Opening</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>Writing</source>
        <translation>写入</translation>
    </message>
    <message>
        <source>Drawing</source>
        <translation>绘制</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::StretchList</name>
    <message>
        <source>left out by you</source>
        <translation>由您略去</translation>
    </message>
    <message>
        <source>left: %1</source>
        <translation>略去：%1</translation>
    </message>
    <message>
        <source>a scene: %1</source>
        <translation>成为场景：%1</translation>
    </message>
    <message>
        <source>a scene, as you decided: %1</source>
        <translation>按您的决定成为场景：%1</translation>
    </message>
    <message>
        <source>%1 s to %2 s: %3</source>
        <translation>%1 s 到 %2 s：%3</translation>
    </message>
    <message>
        <source>%1 s – %2 s</source>
        <translation>%1 s – %2 s</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>seen</source>
        <translation>可见</translation>
    </message>
    <message>
        <source>not seen</source>
        <translation>不可见</translation>
    </message>
    <message>
        <source>no board in the image: %1</source>
        <translation>图像中没有标定板：%1</translation>
    </message>
    <message>
        <source>Still stretch</source>
        <translation>静止时段</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>时长</translation>
    </message>
    <message>
        <source>Images / sweeps</source>
        <translation>图像 / 扫描</translation>
    </message>
    <message>
        <source>Board</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>What becomes of it</source>
        <translation>结果</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TargetCameraDialog</name>
    <message>
        <source>YAML (*.yaml *.yml)</source>
        <translation>YAML (*.yaml *.yml)</translation>
    </message>
    <message>
        <source>Written: %1</source>
        <translation>已写入：%1</translation>
    </message>
    <message>
        <source>Not saved yet</source>
        <translation>尚未保存</translation>
    </message>
    <message>
        <source>%1 (changed)</source>
        <translation>%1（已更改）</translation>
    </message>
    <message>
        <source>Target and camera</source>
        <translation>标定板与相机</translation>
    </message>
    <message>
        <source>Target</source>
        <translation>标定板</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>打开(&amp;O)…</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>保存(&amp;S)</translation>
    </message>
    <message>
        <source>Save &amp;as…</source>
        <translation>另存为(&amp;A)…</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TargetForm</name>
    <message>
        <source>Board of %1 × %2 mm; tags or markers: %3, circles: %4, corners of squares: %5</source>
        <translation>标定板 %1 × %2 mm；标签或标记：%3，圆：%4，方格角点：%5</translation>
    </message>
    <message>
        <source>&amp;Kind of board:</source>
        <translation>标定板类型(&amp;K)：</translation>
    </message>
    <message>
        <source>Tags with circles between them</source>
        <translation>标签，其间有圆</translation>
    </message>
    <message>
        <source>AprilGrid</source>
        <translation>AprilGrid</translation>
    </message>
    <message>
        <source>Checkerboard</source>
        <translation>棋盘格</translation>
    </message>
    <message>
        <source>ChArUco</source>
        <translation>ChArUco</translation>
    </message>
    <message>
        <source>A single AprilTag</source>
        <translation>单个 AprilTag</translation>
    </message>
    <message>
        <source>The board as it would be printed</source>
        <translation>标定板打印出来的样子</translation>
    </message>
    <message>
        <source>Tag family</source>
        <translation>标签族</translation>
    </message>
    <message>
        <source>Which set of AprilTags is printed</source>
        <translation>打印的是哪一组 AprilTag</translation>
    </message>
    <message>
        <source>Dictionary</source>
        <translation>字典</translation>
    </message>
    <message>
        <source>OpenCV&apos;s name of the set of markers</source>
        <translation>OpenCV 中该组标记的名称</translation>
    </message>
    <message>
        <source>Tags in a row</source>
        <translation>每行标签数</translation>
    </message>
    <message>
        <source>Number of tags from left to right</source>
        <translation>从左到右的标签数</translation>
    </message>
    <message>
        <source>Rows of tags</source>
        <translation>标签行数</translation>
    </message>
    <message>
        <source>Number of tags from bottom to top</source>
        <translation>从下到上的标签数</translation>
    </message>
    <message>
        <source>Inner corners in a row</source>
        <translation>每行内角点数</translation>
    </message>
    <message>
        <source>Squares in a row</source>
        <translation>每行方格数</translation>
    </message>
    <message>
        <source>Counted along the rows; of a checkerboard the corners where four squares meet, of a ChArUco board the squares</source>
        <translation>沿行计数；棋盘格为四个方格相交的角点，ChArUco 板为方格</translation>
    </message>
    <message>
        <source>Rows of inner corners</source>
        <translation>内角点行数</translation>
    </message>
    <message>
        <source>Rows of squares</source>
        <translation>方格行数</translation>
    </message>
    <message>
        <source>Counted along the columns; of a checkerboard the corners where four squares meet, of a ChArUco board the squares</source>
        <translation>沿列计数；棋盘格为四个方格相交的角点，ChArUco 板为方格</translation>
    </message>
    <message>
        <source>Number of the tag</source>
        <translation>标签编号</translation>
    </message>
    <message>
        <source>Its number in the family</source>
        <translation>在标签族中的编号</translation>
    </message>
    <message>
        <source>Tag size</source>
        <translation>标签尺寸</translation>
    </message>
    <message>
        <source>Outer edge of the tag&apos;s black border</source>
        <translation>标签黑边的外缘边长</translation>
    </message>
    <message>
        <source>Gap over tag size</source>
        <translation>间隙与标签尺寸之比</translation>
    </message>
    <message>
        <source>White gap between two tags as a part of the tag size</source>
        <translation>两个标签之间的白色间隙相对于标签尺寸的比例</translation>
    </message>
    <message>
        <source>Square size</source>
        <translation>方格尺寸</translation>
    </message>
    <message>
        <source>Edge of a square</source>
        <translation>方格的边长</translation>
    </message>
    <message>
        <source>Square width</source>
        <translation>方格宽度</translation>
    </message>
    <message>
        <source>From one corner to the next in a row</source>
        <translation>同一行相邻角点的距离</translation>
    </message>
    <message>
        <source>Square height</source>
        <translation>方格高度</translation>
    </message>
    <message>
        <source>From one row of corners to the next</source>
        <translation>相邻两行角点的距离</translation>
    </message>
    <message>
        <source>Marker size</source>
        <translation>标记尺寸</translation>
    </message>
    <message>
        <source>Outer edge of a marker</source>
        <translation>标记的外缘边长</translation>
    </message>
    <message>
        <source>Black border, in bits</source>
        <translation>黑边宽度（位）</translation>
    </message>
    <message>
        <source>Width of the tag&apos;s black border: 1 as AprilTag draws it, 2 as Kalibr does</source>
        <translation>标签黑边的宽度：AprilTag 画 1，Kalibr 画 2</translation>
    </message>
    <message>
        <source>First number</source>
        <translation>起始编号</translation>
    </message>
    <message>
        <source>Number of the tag at the lower left; the others follow</source>
        <translation>左下角标签的编号；其余依次递增</translation>
    </message>
    <message>
        <source>Number of the marker at the upper left; the others follow</source>
        <translation>左上角标记的编号；其余依次递增</translation>
    </message>
    <message>
        <source>White square at the top left</source>
        <translation>左上角为白格</translation>
    </message>
    <message>
        <source>Boards of OpenCV before 4.6 with an even number of rows begin with a white square</source>
        <translation>OpenCV 4.6 之前行数为偶数的板以白格开始</translation>
    </message>
    <message>
        <source>Circle radius</source>
        <translation>圆半径</translation>
    </message>
    <message>
        <source>Of the black circles between the tags</source>
        <translation>标签之间的黑色圆</translation>
    </message>
    <message>
        <source>White margin</source>
        <translation>白边</translation>
    </message>
    <message>
        <source>White border beyond the outer tags</source>
        <translation>外侧标签之外的白边</translation>
    </message>
    <message>
        <source>Board width</source>
        <translation>板宽</translation>
    </message>
    <message>
        <source>Of the plate that the print is glued to; blank: it ends with the print</source>
        <translation>粘贴打印件的板；留空表示与打印件同样大小</translation>
    </message>
    <message>
        <source>Board height</source>
        <translation>板高</translation>
    </message>
    <message>
        <source>Print off centre, right</source>
        <translation>打印件偏心，向右</translation>
    </message>
    <message>
        <source>From the middle of the plate to the middle of the print, to the right</source>
        <translation>从板的中心到打印件的中心，向右为正</translation>
    </message>
    <message>
        <source>Print off centre, up</source>
        <translation>打印件偏心，向上</translation>
    </message>
    <message>
        <source>From the middle of the plate to the middle of the print, upwards</source>
        <translation>从板的中心到打印件的中心，向上为正</translation>
    </message>
    <message>
        <source>Measured length</source>
        <translation>测得长度</translation>
    </message>
    <message>
        <source>Any length on the print as a rule tells it; blank: nobody measured</source>
        <translation>用尺在打印件上量得的任意长度；留空表示未测量</translation>
    </message>
    <message>
        <source>The same as drawn</source>
        <translation>设计长度</translation>
    </message>
    <message>
        <source>The length that was measured, as it was meant to be</source>
        <translation>所测长度的设计值</translation>
    </message>
    <message>
        <source>Its standard deviation</source>
        <translation>其标准差</translation>
    </message>
    <message>
        <source>How well the length was measured; blank: 0.5 mm, as a rule is read</source>
        <translation>长度测量的精度；留空表示 0.5 mm，即读尺的精度</translation>
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
        <source>Held: the value is yours and is not fitted</source>
        <translation>固定：采用您的值，不拟合</translation>
    </message>
    <message>
        <source>Value and standard deviation; believable: ±%1%2. Double-click to hold it at a value of yours.</source>
        <translation>值与标准差；可信范围：±%1%2。双击可固定为您的值。</translation>
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
    <message>
        <source>Extrinsic moved by %1; by noise alone it is known to %2.</source>
        <translation>外参移动了 %1；仅就噪声而言，其精度为 %2。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ThresholdPane</name>
    <message>
        <source>a tag&apos;s worst corner (σ)</source>
        <translation>标签最差的角点 (σ)</translation>
    </message>
    <message>
        <source>a circle&apos;s centre (σ)</source>
        <translation>圆心 (σ)</translation>
    </message>
    <message>
        <source>Use this threshold</source>
        <translation>采用此阈值</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>还原</translation>
    </message>
    <message>
        <source>Run the calibration first.</source>
        <translation>请先运行标定。</translation>
    </message>
    <message>
        <source>No circles are in use.</source>
        <translation>没有采用任何圆。</translation>
    </message>
    <message>
        <source>Solving with %1 σ …</source>
        <translation>正在以 %1 σ 求解……</translation>
    </message>
    <message>
        <source>%1: tag %2</source>
        <translation>%1：标签 %2</translation>
    </message>
    <message>
        <source>%1: circle %2</source>
        <translation>%1：圆 %2</translation>
    </message>
    <message numerus="yes">
        <source>%n more</source>
        <translation>
            <numerusform>另有 %n 个</numerusform>
        </translation>
    </message>
    <message>
        <source>With %1 σ, %2 tags and circles are left out (now %3).</source>
        <translation>取 %1 σ 时，有 %2 个标签和圆不采用（现为 %3 个）。</translation>
    </message>
    <message>
        <source>Newly left out: %1.</source>
        <translation>新排除：%1。</translation>
    </message>
    <message>
        <source>Used again: %1.</source>
        <translation>重新采用：%1。</translation>
    </message>
    <message>
        <source>The extrinsic would move by %1 mm and %2 mrad; it would be known to %3 mm and %4 mrad.</source>
        <translation>外参将移动 %1 mm 和 %2 mrad；其不确定度为 %3 mm 和 %4 mrad。</translation>
    </message>
    <message>
        <source>Red: left out at this place of the line. Before the solve has answered, what lies beyond the line; the solve may judge a few of them otherwise, since the board moves too.</source>
        <translation>红色：线在此处时未采用。求解给出结果之前，指线以外的部分；由于标定板也会移动，求解可能对其中少数作出不同判断。</translation>
    </message>
    <message>
        <source>What tags and circles miss the board&apos;s final pose by, in standard deviations. Red ones are left out. Hatched ones lie beyond the line and are in use all the same: they were judged against the poses that tags and circles give alone, and every return has moved these since. Drag the line (or use the arrow keys) to see what another place would do.</source>
        <translation>标签和圆偏离标定板最终位姿的距离，以标准差计。红色的被舍弃。带斜线的超出此线但仍被采用：它们是按仅由标签和圆求得的位姿判断的，此后全部回波又使位姿有所移动。拖动此线（或用方向键）可查看放在别处的效果。</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::ThresholdPlot</name>
    <message>
        <source>how many</source>
        <translation>个数</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TimeLine</name>
    <message>
        <source>Images</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>Clouds</source>
        <translation>点云</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>How much image and cloud change, above the dotted line: motion. Bands are stretches in which both stand still; their edges can be dragged.</source>
        <translation>图像和点云的变化程度，虚线以上为运动。色带是两者都静止的时段；其边缘可以拖动。</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TopicList</name>
    <message>
        <source>Topic</source>
        <translation>话题</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>消息数</translation>
    </message>
    <message>
        <source>Rate</source>
        <translation>频率</translation>
    </message>
    <message>
        <source>From – to</source>
        <translation>起止时间</translation>
    </message>
    <message>
        <source>%1 Hz</source>
        <translation>%1 Hz</translation>
    </message>
    <message>
        <source>%1 s – %2 s</source>
        <translation>%1 s – %2 s</translation>
    </message>
    <message>
        <source>Raw: convert it with %1</source>
        <translation>原始数据：请用 %1 转换</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::TransitionPlot</name>
    <message>
        <source>distance from the circle (mm), outside positive</source>
        <translation>到圆的距离 (mm)，向外为正</translation>
    </message>
    <message>
        <source>intensity, black 0 to white 1</source>
        <translation>强度，黑 0 至白 1</translation>
    </message>
    <message>
        <source>intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>Intensity of the returns about the circles against the signed distance to the nearest one. Small dots: samples (of many, some), blue those of the overlap region. Marks: means in classes of a millimetre with their standard deviation. Line: the fitted error function; δ is where it is half way, σ its width.</source>
        <translation>圆周围回波的强度与到最近圆的有符号距离的关系。小点：样本（过多时取一部分），蓝色为重叠区样本。标记：每毫米分组的均值及其标准差。曲线：拟合的误差函数；δ 为其居中处，σ 为其宽度。</translation>
    </message>
    <message>
        <source>no data</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>δ = %1 mm
σ = %2 mm</source>
        <translation>δ = %1 mm
σ = %2 mm</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>样本</translation>
    </message>
    <message>
        <source>overlap region</source>
        <translation>重叠区</translation>
    </message>
    <message>
        <source>means</source>
        <translation>均值</translation>
    </message>
    <message>
        <source>… a colour for each scene</source>
        <translation>……每个场景一种颜色</translation>
    </message>
    <message>
        <source>fit</source>
        <translation>拟合</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::UncertaintyMapPlot</name>
    <message>
        <source>image u (px)</source>
        <translation>图像 u (px)</translation>
    </message>
    <message>
        <source>image v (px)</source>
        <translation>图像 v (px)</translation>
    </message>
    <message>
        <source>no result yet</source>
        <translation>尚无结果</translation>
    </message>
    <message>
        <source>standard deviation by noise (px)</source>
        <translation>噪声引起的标准差 (px)</translation>
    </message>
    <message>
        <source>Where in the image a LiDAR point falls is known to one standard deviation of so many pixels, by the noise of these scenes alone. Where the colour is bright, take a scene with the board there.</source>
        <translation>激光点落在图像中的位置的一倍标准差（像素），仅由这些场景的噪声引起。在颜色明亮处，请拍摄标定板位于该处的场景。</translation>
    </message>
    <message>
        <source>standard deviation (px)</source>
        <translation>标准差 (px)</translation>
    </message>
    <message>
        <source>Where in the image a direction falls is known to one standard deviation of so many pixels. Where the colour is bright, take images with the board there.</source>
        <translation>一个方向落在图像何处，其标准差为这么多像素。颜色明亮之处，请把标定板放到那里再拍图像。</translation>
    </message>
    <message>
        <source>the intrinsics are taken as given, without standard deviations</source>
        <translation>内参按给定值使用，没有标准差</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::UncertaintyPane</name>
    <message>
        <source>Uncertainty</source>
        <translation>不确定度</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::UncertaintyRangePlot</name>
    <message>
        <source>range (m)</source>
        <translation>距离 (m)</translation>
    </message>
    <message>
        <source>standard deviation (mm)</source>
        <translation>标准差 (mm)</translation>
    </message>
    <message>
        <source>across the ray</source>
        <translation>垂直于光线</translation>
    </message>
    <message>
        <source>along the ray</source>
        <translation>沿光线</translation>
    </message>
    <message>
        <source>no result yet</source>
        <translation>尚无结果</translation>
    </message>
    <message>
        <source>How far a LiDAR point at this range may lie beside its true place in the camera frame: one standard deviation across the ray and along it. Through: in total, with what common errors that these scenes do not show could still do. Dashed: by noise alone.</source>
        <translation>该距离处的激光点在相机坐标系中可能偏离真实位置多远：垂直于光线和沿光线的一倍标准差。实线：总计，再加上这些场景看不出的常见误差可能造成的影响。虚线：仅由噪声引起。</translation>
    </message>
    <message>
        <source>by noise alone</source>
        <translation>仅由噪声引起</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::WatchWindow</name>
    <message>
        <source>No result yet</source>
        <translation>尚无结果</translation>
    </message>
    <message>
        <source>%1 is being solved …</source>
        <translation>%1 求解中 …</translation>
    </message>
    <message>
        <source>%1 not taken: %2</source>
        <translation>%1 未采用：%2</translation>
    </message>
    <message>
        <source>%1: no result: %2</source>
        <translation>%1：没有结果：%2</translation>
    </message>
    <message>
        <source>%1 is taken</source>
        <translation>%1 已采用</translation>
    </message>
    <message>
        <source>Waiting for the next scene</source>
        <translation>等待下一个场景</translation>
    </message>
    <message>
        <source>Watching has ended</source>
        <translation>监视已结束</translation>
    </message>
    <message>
        <source>Watching %1</source>
        <translation>正在监视 %1</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>(and %1 more)</source>
        <translation>（另有 %1 个）</translation>
    </message>
    <message>
        <source>Scenes: %1</source>
        <translation>场景：%1</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>Next: %1</source>
        <translation>下一步：%1</translation>
    </message>
    <message>
        <source>Stand by …</source>
        <translation>请稍候 …</translation>
    </message>
    <message>
        <source>Looking for the next pose …</source>
        <translation>正在寻找下一个位姿 …</translation>
    </message>
    <message>
        <source>Next: the whole board in view of both, two metres ahead</source>
        <translation>下一步：前方两米，整块标定板在两者视野内</translation>
    </message>
    <message>
        <source>What next</source>
        <translation>下一步</translation>
    </message>
    <message>
        <source>&amp;Full screen</source>
        <translation>全屏(&amp;F)</translation>
    </message>
    <message>
        <source>Larger, to be read from farther away (F11)</source>
        <translation>更大，便于更远处阅读 (F11)</translation>
    </message>
    <message>
        <source>&amp;Stop watching</source>
        <translation>停止监视(&amp;S)</translation>
    </message>
    <message>
        <source>top</source>
        <translation>上</translation>
    </message>
    <message>
        <source>Where the board is to be in the camera&apos;s picture, its upper edge marked</source>
        <translation>标定板应在相机画面中的位置，标出其上边</translation>
    </message>
    <message>
        <source>Scenes: %1/%2</source>
        <translation>场景：%1/%2</translation>
    </message>
    <message>
        <source>One standard deviation of the extrinsic&apos;s position and rotation in total, and the tolerance of each (Parameters)</source>
        <translation>外参位置与旋转的总标准差（一个 σ），以及各自的容差（参数）</translation>
    </message>
    <message>
        <source>σ %1 of %2 mm, %3 of %4 mrad</source>
        <translation>σ %1 / %2 mm，%3 / %4 mrad</translation>
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
        <source>Guide</source>
        <translation>指南</translation>
    </message>
    <message>
        <source>From the printed board to a result, step by step</source>
        <translation>从打印标定板到结果的逐步说明</translation>
    </message>
    <message>
        <source>Simulates four scenes with an effect hidden in them, and a tour to find it</source>
        <translation>模拟四个藏有一个效应的场景，并带您找到它</translation>
    </message>
    <message>
        <source>New from a recording</source>
        <translation>从记录新建</translation>
    </message>
    <message>
        <source>A ROS bag, rosbag2 or MCAP in which board and rig stood still</source>
        <translation>标定板与传感器曾静止的 ROS bag、rosbag2 或 MCAP 记录</translation>
    </message>
    <message>
        <source>Recent (or drop a folder or a recording on this window)</source>
        <translation>最近使用（或将文件夹、记录拖到此窗口）</translation>
    </message>
    <message>
        <source>New from files</source>
        <translation>从文件新建</translation>
    </message>
    <message>
        <source>Images and clouds in folders, matched by name or by time</source>
        <translation>文件夹中的图像和点云，按名称或时间配对</translation>
    </message>
    <message>
        <source>Describe a target or a camera</source>
        <translation>描述标定板或相机</translation>
    </message>
    <message>
        <source>target.yaml and camera.yaml from what you know of both</source>
        <translation>根据已知信息生成 target.yaml 和 camera.yaml</translation>
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
        <source>&lt;b&gt;What if&lt;/b&gt;</source>
        <translation>&lt;b&gt;假如&lt;/b&gt;</translation>
    </message>
    <message>
        <source>Size of the effect</source>
        <translation>效应的大小</translation>
    </message>
    <message>
        <source>Orange: what the poses would leave of it. New scenes are planned to show %1%2.</source>
        <translation>橙色：位姿调整后剩下的部分。规划新场景时以能看出 %1%2 为准。</translation>
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
    <message>
        <source>Exclude these</source>
        <translation>排除所选</translation>
    </message>
    <message>
        <source>Leave out what is selected, in every scene, and solve again; of corners their tags</source>
        <translation>在所有场景中排除所选内容并重新求解；对于角点，排除其所在的标签</translation>
    </message>
    <message>
        <source>the residuals are being collected …</source>
        <translation>正在收集残差 …</translation>
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
        <translation>
            <numerusform>已打开 %1，共 %n 个场景。</numerusform>
        </translation>
    </message>
    <message>
        <source>Saved %1.</source>
        <translation>已保存 %1。</translation>
    </message>
    <message>
        <source>No result: %1</source>
        <translation>没有结果：%1</translation>
    </message>
    <message>
        <source>%1: %2 of %3 scenes, %4 px, %5 mm</source>
        <translation>%1：%2/%3 个场景，%4 px，%5 mm</translation>
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
        <source>New: scene %1</source>
        <translation>新增：场景 %1</translation>
    </message>
    <message>
        <source>The dataset was read again</source>
        <translation>已重新读取数据集</translation>
    </message>
    <message>
        <source>good so far</source>
        <translation>目前良好</translation>
    </message>
</context>
<context>
    <name>lvcalib::widgets::WorldPane</name>
    <message>
        <source>Scene</source>
        <translation>场景</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>强度</translation>
    </message>
    <message>
        <source>Range</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>Colour of the points</source>
        <translation>点的颜色</translation>
    </message>
    <message>
        <source>run the calibration first</source>
        <translation>请先运行标定</translation>
    </message>
    <message>
        <source>What the colours of the points tell. Lines: every board as the LiDAR (orange) and as the camera sees it (blue), the LiDAR&apos;s axes (x red, y green, z blue), the views of both (pyramids). A click on a board goes to its scene.</source>
        <translation>点的颜色所表示的量。线条：激光雷达所见（橙色）与相机所见（蓝色）的各标定板、激光雷达坐标轴（x 红、y 绿、z 蓝）、两者的视野（棱锥）。单击标定板可转到其场景。</translation>
    </message>
</context>
<context>
    <name>main</name>
    <message>
        <source>LiDAR-camera calibration with a printed board</source>
        <translation>用打印标定板标定激光雷达与相机</translation>
    </message>
    <message>
        <source>Folder for settings and data, instead of the user&apos;s.</source>
        <translation>存放设置和数据的文件夹，代替用户默认位置。</translation>
    </message>
    <message>
        <source>Dataset folder or project.</source>
        <translation>数据集文件夹或项目。</translation>
    </message>
    <message>
        <source>Truth of a simulated dataset, to show the distance to it.</source>
        <translation>仿真数据集的真值，用于显示与它的距离。</translation>
    </message>
</context>
</TS>
