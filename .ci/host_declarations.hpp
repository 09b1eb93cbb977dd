// What the programs beside a contact law use of LAMMPS, LIGGGHTS, MercuryDPM, YADE and DEM-Engine, declared as these codes do in their public
// headers, so that check_law.py compiles the programs without the codes.
#pragma once
#include <cmath>
#include <iostream>
#include <memory>
#include <set>
#include <string>

#if defined(HOST_LIGGGHTS)
#define FLERR __FILE__, __LINE__
enum { CONTACT_NORMAL_MODEL = 1 };
struct LAMMPS;
struct IContactHistorySetup { virtual int add_history_value(std::string, std::string) = 0; };
struct Settings;
struct PropertyRegistry;
namespace LIGGGHTS { namespace ContactModels {
class ContactModelBase;
struct SurfacesCloseData { double area_ratio; int *contact_flags; double *contact_history; bool is_wall; int computeflag, shearupdate; };
struct SurfacesIntersectData : SurfacesCloseData { double en[3], kt, kn, gammat, gamman, Fn, vn, deltan; };
struct ForceData { double delta_F[3]; };
struct NormalModelBase {
  NormalModelBase(LAMMPS *, IContactHistorySetup *, ContactModelBase *);
  struct { double dt; } *update;
  struct { int oneatom, pgsize; } *neighbor;
  struct { void all(const char *, int, const char *); } *error;
  virtual void registerSettings(Settings &) = 0;
  virtual void postSettings(IContactHistorySetup *, ContactModelBase *) = 0;
  virtual void connectToProperties(PropertyRegistry &) = 0;
  virtual double stressStrainExponent() = 0;
  virtual void surfacesIntersect(SurfacesIntersectData &, ForceData &, ForceData &) = 0;
  virtual void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) = 0;
  virtual void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) = 0;
  virtual void endPass(SurfacesIntersectData &, ForceData &, ForceData &) = 0;
};
template<int> class NormalModel;
} }
#elif defined(HOST_LAMMPS)
#define FLERR __FILE__, __LINE__
namespace MathExtra {
double dot3(const double *, const double *);
void norm3(double *), cross3(const double *, const double *, double *);
}
namespace LAMMPS_NS {
class LAMMPS;
struct Error { void all(const char *, int, const char *); };
namespace Granular_NS {
class GranularModel;
struct GranSubMod {
  GranSubMod(GranularModel *, LAMMPS *);
  virtual void init();
  std::string name;
  int size_history, nondefault_history_transfer, history_index, beyond_contact;
  double *transfer_history_factor;
  GranularModel *gm;
  Error *error;
};
struct GranSubModNormal : GranSubMod {
  GranSubModNormal(GranularModel *, LAMMPS *);
  virtual bool touch();
  virtual double pulloff_distance(double, double), calculate_contact_radius(), calculate_forces() = 0;
  virtual void set_fncrit();
  double damp, Fncrit;
};
struct GranSubModTangential : GranSubMod {
  GranSubModTangential(GranularModel *, LAMMPS *);
  virtual void calculate_forces() = 0;
  double k, damp, mu;
};
struct GranularModel {
  GranSubModNormal *normal_model;
  double dt, delta, vnnr, rsq, radsum, dR, Fntot, nx[3], vtr[3], fs[3], *history;
  int touch, history_update;
};
}
}
#elif defined(HOST_MERCURY)
typedef double Mdouble;
struct Vec3D { Vec3D(double, double, double); static double dot(const Vec3D &, const Vec3D &); Vec3D operator-(const Vec3D &) const; };
Vec3D operator*(double, const Vec3D &);
struct BaseInteractable { Vec3D getVelocityAtContact(const Vec3D &) const; };
struct DPMBase { Mdouble getTimeStep() const; };
struct InteractionHandler { DPMBase *getDPMBase() const; };
struct BaseInteraction {
  BaseInteraction();
  BaseInteraction(BaseInteractable *, BaseInteractable *, unsigned);
  virtual Mdouble getElasticEnergy() const;
  virtual Mdouble getElasticEnergyAtEquilibrium(Mdouble) const;
  const BaseInteractable *getP() const, *getI() const;
  const Vec3D &getContactPoint() const, &getNormal() const, &getRelativeVelocity() const;
  Mdouble getOverlap() const, getNormalRelativeVelocity() const;
  InteractionHandler *getHandler() const;
  void setRelativeVelocity(Vec3D), setForce(Vec3D), setTorque(Vec3D), setNormalRelativeVelocity(Mdouble), setAbsoluteNormalForce(Mdouble);
};
struct BaseNormalForce {};
template<class Normal> struct Species : Normal { typename Normal::InteractionType contact; };
template<class Normal> struct MixedSpecies : Normal {};
#elif defined(HOST_YADE)
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(self, base, text, attributes, constructor) self() { constructor }
#define YADE_CLASS_BASE_DOC(self, base, text)
#define REGISTER_CLASS_INDEX(self, base) int index()
#define REGISTER_SERIALIZABLE(self) static_assert(sizeof(self) > 0, #self)
#define FUNCTOR2D(one, two) static_assert(sizeof(one) + sizeof(two) > 0, "")
#define YADE_PLUGIN(classes) static_assert(true, #classes)
namespace yade {
using std::shared_ptr;
typedef double Real;
struct Vector3r { Vector3r operator-(const Vector3r &) const, operator-() const; void operator+=(const Vector3r &); Real dot(const Vector3r &) const; };
Vector3r operator*(Real, const Vector3r &);
struct Material {};
struct FrictMat : Material {};
struct IGeom { virtual ~IGeom(); };
struct ScGeom : IGeom { Vector3r normal; Real penetrationDepth; };
struct IPhys { virtual ~IPhys(); void createIndex(); };
struct NormShearPhys : IPhys { Vector3r normalForce; };
struct Interaction { shared_ptr<IPhys> phys; int cellDist; int getId1() const, getId2() const; };
struct Scene {
  Real dt;
  bool isPeriodic;
  struct Cells { Vector3r intrShiftVel(int); };
  shared_ptr<Cells> cell;
  struct { void addForce(int, const Vector3r &); } forces;
};
struct Body { struct State { Vector3r vel; }; shared_ptr<State> state; static const shared_ptr<Body> &byId(int, Scene *); };
struct IPhysFunctor { virtual void go(const shared_ptr<Material> &, const shared_ptr<Material> &, const shared_ptr<Interaction> &) = 0; };
struct LawFunctor { Scene *scene; virtual bool go(shared_ptr<IGeom> &, shared_ptr<IPhys> &, Interaction *) = 0; };
}
#elif defined(HOST_DEME)
namespace deme {
struct DEMForceModel { void DefineCustomModelPrerequisites(const std::string &), SetPerContactWildcards(const std::set<std::string> &); };
struct DEMSolver { std::shared_ptr<DEMForceModel> DefineContactForceModel(const std::string &); };
}
#endif
