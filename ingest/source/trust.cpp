#include "ingest/source/trust.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "ingest/refusal.hpp"

namespace relevo::ingest {
namespace {

// Rasters of heights, and grids of undulations for --geoid. Not here: what reads from networks or databases
// (WMS, WCS, STAC..., PostGIS), files that name others anywhere (MRF, ERS, PDS), and satellite scenes.
constexpr std::array kDrivers{
    "VRT",         "GTiff",  "SRTMHGT", "DTED",      "USGSDEM",  "AAIGrid",   "GRASSASCIIGrid",
    "AIG",         "netCDF", "HDF5",    "HDF5Image", "HDF4",     "HDF4Image", "BAG",
    "HFA",         "ENVI",   "EHdr",    "GenBin",    "EIR",      "SAGA",      "GSAG",
    "GSBG",        "GS7BG",  "RMF",     "RST",       "PCRaster", "BT",        "Terragen",
    "Leveller",    "HF2",    "SIGDEM",  "ACE2",      "SDTS",     "JDEM",      "NWT_GRD",
    "GXF",         "ZMap",   "XYZ",     "BLX",       "LCP",      "GPKG",      "GRIB",
    "JP2OpenJPEG", "PNG",    "JPEG",    "BMP",       "PNM",      "GTX",       "NTv2",
    "CTable2",     "LOSLAS", "ISG",     "BYN",       "NGSGEOID"};

constexpr std::array kNetworkFolders{"/vsicurl", "/vsis3",    "/vsigs",   "/vsiaz",     "/vsiadls",
                                     "/vsioss",  "/vsiswift", "/vsihdfs", "/vsiwebhdfs"};
constexpr std::array kNetworkSchemes{"http://", "https://", "ftp://", "s3://", "gs://", "az://", "dap://"};

bool starts_with(const std::string& text, const char* start) {
    return text.compare(0, std::strlen(start), start) == 0;
}

}  // namespace

const char* const* elevation_drivers() {
    static constexpr auto kList = [] {
        std::array<const char*, kDrivers.size() + 1> list{};
        std::copy(kDrivers.begin(), kDrivers.end(), list.begin());
        return list;
    }();
    return kList.data();
}

bool is_elevation_driver(const std::string& name) {
    return std::any_of(kDrivers.begin(), kDrivers.end(), [&](const char* driver) { return name == driver; });
}

bool is_remote(const std::string& name) {
    const auto leads_to = [&](const char* part) { return name.find(part) != std::string::npos; };
    return std::any_of(kNetworkFolders.begin(), kNetworkFolders.end(), leads_to) ||
           std::any_of(kNetworkSchemes.begin(), kNetworkSchemes.end(), leads_to);
}

Result<void> check_input_name(const std::string& name, const Trust& trust) {
    if (is_remote(name) && !trust.allow_remote)
        return refusal(name, "it lies in a network", "Fetch it first, or give --allow-remote");
    const auto first = name.find_first_not_of(" \t\r\n");
    const bool text = first != std::string::npos && (name[first] == '<' || name[first] == '{');
    if (text || starts_with(name, "vrt:") || starts_with(name, "/vsistdin"))
        return refusal(name.substr(0, 60), "it is not the name of a file",
                       "Write it to a file and give that as INPUT");
    return {};
}

}  // namespace relevo::ingest
