//! The adapter and the device: hardware first, software if there is none, a clear word if neither.

use std::fmt;
use std::sync::{Arc, Mutex};

/// Which adapters may be taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Hardware if there is any, else software.
    #[default]
    Any,
    /// Software only: the same picture wherever the same driver runs.
    Software,
}

/// Why there is no device.
#[derive(Debug)]
pub enum GpuError {
    /// No adapter at all.
    NoAdapter,
    /// An adapter that gives no device, or lost it, or refused work; in its own words.
    Device(String),
}

impl fmt::Display for GpuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter => write!(
                f,
                "no graphics adapter was found, not even a software one; install a Vulkan driver, \
                 such as Debian's package mesa-vulkan-drivers, which needs no graphics card"
            ),
            Self::Device(words) => write!(f, "the graphics device failed: {words}"),
        }
    }
}

impl std::error::Error for GpuError {}

/// A device with what was found out about it. Copies are the same device, and share its errors.
#[derive(Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name, driver and kind.
    pub info: wgpu::AdapterInfo,
    /// The instance, which a window's surface is made by.
    pub instance: wgpu::Instance,
    /// The adapter, which a window's surface is asked about.
    pub adapter: wgpu::Adapter,
    /// Volumes may reach behind the near plane without being cut.
    pub has_depth_clip_control: bool,
    /// Triangles can be drawn as their edges.
    pub has_wireframe: bool,
    /// Triangles can be drawn as their corners.
    pub has_points: bool,
    error: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Finds an adapter and makes a device.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`] if there is none that may be taken, [`GpuError::Device`] if it
    /// gives no device.
    pub fn new(choice: AdapterChoice) -> Result<Self, GpuError> {
        let instance =
            wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(find_adapter(&instance, choice))?;
        let info = adapter.get_info();
        let wanted = wgpu::Features::DEPTH32FLOAT_STENCIL8
            | wgpu::Features::DEPTH_CLIP_CONTROL
            | wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::POLYGON_MODE_LINE
            | wgpu::Features::POLYGON_MODE_POINT;
        let features = adapter.features() & wanted;
        if !features.contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
            return Err(GpuError::Device(format!(
                "{} has no depth buffer of 32 bits with a stencil",
                info.name
            )));
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("ivory"),
            required_features: features,
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| GpuError::Device(error.to_string()))?;
        let error = Arc::new(Mutex::new(None));
        let first_error = Arc::clone(&error);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            keep_first(&first_error, error.to_string());
        }));
        let first_error = Arc::clone(&error);
        device.set_device_lost_callback(move |_, words| {
            keep_first(&first_error, format!("it was lost: {words}"));
        });
        Ok(Self {
            device,
            queue,
            info,
            instance,
            adapter,
            has_depth_clip_control: features.contains(wgpu::Features::DEPTH_CLIP_CONTROL),
            has_wireframe: features.contains(wgpu::Features::POLYGON_MODE_LINE),
            has_points: features.contains(wgpu::Features::POLYGON_MODE_POINT),
            error,
        })
    }

    /// Whether the adapter computes on the CPU.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The first error since the last call.
    ///
    /// # Errors
    ///
    /// [`GpuError::Device`] if the device refused something.
    pub fn check(&self) -> Result<(), GpuError> {
        match self.error.lock().ok().and_then(|mut error| error.take()) {
            None => Ok(()),
            Some(words) => Err(GpuError::Device(words)),
        }
    }
}

fn keep_first(slot: &Mutex<Option<String>>, words: String) {
    if let Ok(mut slot) = slot.lock() {
        slot.get_or_insert(words);
    }
}

async fn find_adapter(
    instance: &wgpu::Instance,
    choice: AdapterChoice,
) -> Result<wgpu::Adapter, GpuError> {
    let mut adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
    adapters.retain(|adapter| {
        let is_software = adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let is_capable = adapter
            .features()
            .contains(wgpu::Features::DEPTH32FLOAT_STENCIL8);
        is_capable && (choice == AdapterChoice::Any || is_software)
    });
    adapters
        .into_iter()
        .min_by_key(|adapter| {
            let info = adapter.get_info();
            let kind = match info.device_type {
                wgpu::DeviceType::DiscreteGpu => 0,
                wgpu::DeviceType::IntegratedGpu => 1,
                wgpu::DeviceType::VirtualGpu => 2,
                wgpu::DeviceType::Other => 3,
                wgpu::DeviceType::Cpu => 4,
            };
            // The OpenGL back end is the last choice for the same kind of device.
            (kind, info.backend == wgpu::Backend::Gl)
        })
        .ok_or(GpuError::NoAdapter)
}
